#include "formats/base/version.h"

namespace lozenge {

std::string_view version() { return LOZENGE_VERSION; }

}  // namespace lozenge
