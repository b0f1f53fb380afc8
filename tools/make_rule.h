// The format in which compilers tell make and ninja what a file was made from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lozenge {

/// "target: a b", and for each file a rule without a recipe, so that make doesn't fail where one is gone. Spaces and
/// the other letters that make takes for its own are escaped; what it can't be told (a line break) is left out.
std::string make_rule(const std::string& target, const std::vector<std::filesystem::path>& files);

}  // namespace lozenge
