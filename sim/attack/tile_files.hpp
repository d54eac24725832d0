#pragma once
#include <string>
#include <vector>

#include "sim/attack/attack_case.hpp"

namespace ridgeline::sim {

/// Writes one tile of a case into `folder` under the usual name of its format; GeoTIFFs are named
/// after their number `index`.
/// Shape:  `posts` as posts_of() gives them.
/// Error:  Fault::file_unwritable with the reason.
[[nodiscard]] Outcome write_tile(const std::string& folder, std::size_t index, const TilePlan& tile,
                                 const std::vector<float>& posts);

/// Where the files of a case stand; empty names: the case has no such file.
struct CaseFiles {
  std::string terrain_folder, coverage_file, edit_file, geoid_file;
};

/// Writes everything a case is drawn from into an existing folder.
[[nodiscard]] Outcome write_case(const std::string& folder, const AttackCase& attack_case,
                                 CaseFiles& files);

}  // namespace ridgeline::sim
