// What became of a batch, as a page to look at.
#pragma once

#include <string>
#include <vector>

#include "pipeline/batch/batch_manifest.h"

namespace lozenge {

/// A page of HTML that needs nothing but the outputs beside it: a table with a row and a preview for each asset, those
/// first that failed. A click on a column's head sorts by it; so does an address that ends in #sort=seconds, or, the
/// largest first, #sort=-seconds.
std::string batch_page(const std::vector<BatchRow>& rows);

}  // namespace lozenge
