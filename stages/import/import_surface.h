// The whole import: read, weld, repair, fill.
#pragma once

#include "stages/import/import.h"

namespace lozenge {

/// `import_asset`, whose surface is then made an oriented 2-manifold with boundary (repair.h) and whose small holes are
/// filled (fill_holes.h). What that took is in the report, as notes too.
/// \throws Error as import_asset; Error(kUnusableInput) where all triangles are flat, or where repair is needed and
/// `options.strict` allows none
SourceMesh import_surface(const std::filesystem::path& path, const ImportOptions& options = {},
                          const Progress& progress = {}, ImportReport* result = nullptr);

/// What an import does to a surface once it is welded: T-junctions are joined (but not again, where they were before:
/// `was_repaired`), repairs made, holes filled. \return false, with holes left, where no triangle has any area
bool mend(SourceMesh& mesh, const ImportOptions& options, bool was_repaired, RepairReport& report);

}  // namespace lozenge
