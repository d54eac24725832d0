// ridgeline-published-holes FOLDER: the pictures and the tables of
// docs/evidence/published_holes.md. Synthetic terrain only; the same driver gives the same bytes.
#include <cstdio>
#include <filesystem>

#include "tests/methods/hole_figure.hpp"
#include "tests/methods/hole_tables.hpp"

namespace ridgeline::test {
namespace {

int run(const std::string& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) {
    std::fprintf(stderr, "%s: %s\n", folder.c_str(), fault.message().c_str());
    return 3;
  }
  std::printf(
      "| picture | scene | claimed, px | pixels judged | wrong | of them without an error in the "
      "buffer | sky where ground stands | ray cast | largest real error, px | wrong in ours |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Hole& hole : published_holes()) {
    HoleNumbers n;
    if (const sim::Outcome drawn = draw_hole(hole, folder, n); !drawn.ok()) {
      std::fprintf(stderr, "%s\n", drawn.message.c_str());
      return 3;
    }
    std::printf(
        "| `%s` | %s | %g | %d | %d (%d unsound, %d incomplete) | %d | %d | %.1f %% | %s%.1f | %d "
        "|\n",
        hole.file.c_str(), hole.what.c_str(), hole.claim_px, n.judged, n.wrong, n.unsound,
        n.incomplete, n.wrong_uncast, n.lost, n.cast_percent, n.max_is_more ? "> " : "", n.max_px,
        n.ours_wrong);
    std::fflush(stdout);
  }
  return print_hole_tables(folder);
}

}  // namespace
}  // namespace ridgeline::test

int main(int count, char** words) {
  if (count != 2) {
    std::fprintf(stderr, "usage: ridgeline-published-holes FOLDER\n");
    return 2;
  }
  return ridgeline::test::run(words[1]);
}
