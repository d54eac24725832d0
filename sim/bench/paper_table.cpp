#include "sim/bench/paper_table.hpp"

#include <algorithm>
#include <cstdio>

namespace ridgeline::sim {
namespace {

/// Ours and the two exact ones stand under every paper's rows.
std::vector<PaperRow> with_ours(std::vector<PaperRow> rows) {
  for (const char* spec : {"mesh", "embree", "raycast", "ridgeline:error=1"}) {
    const bool there = std::any_of(rows.begin(), rows.end(), [&](const PaperRow& row) {
      return std::string_view(row.spec) == spec;
    });
    if (!there) rows.push_back({spec, "not in the paper", std::nullopt, ""});
  }
  return rows;
}

std::vector<Paper> all_papers() {
  std::vector<Paper> all;
  all.push_back(
      {"loffler", "Löffler, Rybacki, Schumann: Error-bounded GPU-supported terrain visualisation",
       "GeForce 8800 GTX, Puget Sound 4k, mean of 8000 frames", 1024, 800,
       with_ours({
           {"loffler:grid=1024x512,rays=0", "1024x512, warped", 61.5, "7.5 %, 1.42, 6.77"},
           {"loffler:grid=1024x512,warp=0,rays=0", "1024x512, uniform", 68.7, "10.7 %, 1.60, 18.0"},
           {"loffler:grid=1024x512", "1024x512, warped, rays", 36.4, ""},
           {"loffler:grid=1024x512,warp=0", "1024x512, uniform, rays", 33.4, ""},
           {"loffler:grid=512x256,rays=0", "512x256, warped", 218.0, "12.1 %, –, 6.9"},
           {"loffler:grid=512x256", "512x256, warped, rays", 70.2, ""},
           {"loffler:grid=400x1900,rays=0", "400x1900, warped", 45.8, "7.4 %, –, 6.7"},
           {"loffler:grid=400x1900", "400x1900, warped, rays", 25.3, ""},
       }),
       "The paper counts error pixels by its own metric at grid vertices; ours are per pixel, "
       "against the exact surface."});
  all.push_back({"livny", "Livny et al.: A GPU persistent grid mapping for terrain rendering",
                 "GeForce 7800 GTX, Puget Sound 16k; picture size not stated, 1024 x 768 here",
                 1024, 768,
                 with_ours({
                     {"pgm:grid=400x1600", "400x1600 (1.28 M triangles)", 35.0, ""},
                     {"pgm:grid=430x430", "430x430 (370 k triangles)", 112.0, ""},
                     {"pgm:grid=150x600", "150x600, the paper's smallest", std::nullopt, ""},
                     {"clipmap", "geometry clipmaps, its yardstick", std::nullopt, ""},
                 }),
                 "The paper reports no error."});
  all.push_back(
      {"ammann", "Ammann, Génevaux, Dischler: Hybrid rendering of dynamic heightfields",
       "GeForce GTX 280, Como 4k, 1024 x 768", 1024, 768,
       with_ours({
           {"hybrid:t=70,k=1.3", "hybrid, T = 70, k = 1.3: 40 to 150", 95.0,
            "PSNR 68 to 78 dB of distance"},
           {"hybrid:t=280,k=1.3,cell=32", "as it would choose with posts four times as dense",
            std::nullopt, ""},
           {"hybrid:t=1e9,k=0.001,cell=16", "rays alone, 64 + 25 steps, grazing", 47.0, ""},
           {"hybrid:t=1e9,k=1000,cell=16", "rays alone, 5 + 2 steps, grazing", 360.0,
            "30.5 % of pixels off by 1 % of the terrain"},
           {"mesh", "full mesh: 5 to 9", 7.0, "reference"},
           {"clipmap", "geometry clipmap", std::nullopt, "PSNR 59 dB"},
       }),
       "A published span stands as its middle; rays alone were published over another map (Mont "
       "Blanc 4k), and here a cell that reaches behind the eye is still a mesh. Its error "
       "is of distance along the ray, which has no bound at a silhouette, so ours cannot "
       "be put beside it."});
  all.push_back({"dachsbacher",
                 "Dachsbacher, Stamminger: Rendering procedural terrain by geometry image warping",
                 "Radeon 9700, 512 x 512, procedural terrain with detail", 512, 512,
                 with_ours({
                     {"warp:grid=512", "512x512 mesh", 35.0, ""},
                     {"warp:grid=256", "256x256 mesh", std::nullopt, ""},
                     {"warp:grid=1024", "1024x1024 mesh", std::nullopt, ""},
                 }),
                 "The paper says that it can guarantee no error; detail is off here, for it would "
                 "count as error."});
  return all;
}

std::string number(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

const BenchRow* find_row(const BenchResult& result, const char* spec) {
  for (const BenchRow& row : result.rows) {
    if (row.view == "all" && row.spec == spec && !row.frame_ms.empty()) return &row;
  }
  return nullptr;
}

std::string absence(const BenchResult& result, const char* spec) {
  for (const AbsentMethod& absent : result.absent) {
    if (absent.spec == spec) return "absent: " + absent.why;
  }
  return "not drawn";
}

/// Speed by that of the first row; nothing where either is missing. By CPU time, which is what
/// passes cost on a software GPU whatever else the machine does.
std::optional<double> our_ratio(const BenchRow* ours, const BenchRow* first) {
  if (ours == nullptr || first == nullptr) return std::nullopt;
  return first->median_core_ms() / ours->median_core_ms();
}

std::optional<double> published_ratio(const PaperRow& row, const PaperRow& first) {
  if (!row.fps || !first.fps) return std::nullopt;
  return *row.fps / *first.fps;
}

std::string or_dash(const std::optional<double>& value) {
  return value ? number("%.2f", *value) : "–";
}

std::string our_cells(const BenchResult& result, const PaperRow& row, const PaperRow& first_row) {
  const BenchRow* const ours = find_row(result, row.spec);
  if (ours == nullptr) return absence(result, row.spec) + " | – | – | – | – | – | – | – | – | – |";
  const std::optional<double> ratio = our_ratio(ours, find_row(result, first_row.spec));
  const std::optional<double> published = published_ratio(row, first_row);
  const bool both = ratio && published;
  const BenchError& error = ours->error;
  return number("%.1f | ", ours->median_ms()) + number("%.1f | ", ours->median_core_ms()) +
         or_dash(ratio) + " | " +
         or_dash(both ? std::optional(*ratio / *published) : std::nullopt) + " | " +
         number("%.2f", error.percent_over_px(1.0)) + number(" | %.3f", error.mean_px()) +
         (error.worst_is_larger ? " | > " : " | ") + number("%.2f", error.worst_px) + " | " +
         std::to_string(error.wrong_class) + number(" | %.0f | ", 100.0 * ours->ray_cast_share) +
         steps_text(*ours) + " |";
}

}  // namespace

const std::vector<Paper>& papers() {
  static const std::vector<Paper> all = all_papers();
  return all;
}

const Paper* find_paper(std::string_view name) {
  for (const Paper& paper : papers()) {
    if (paper.name == name) return &paper;
  }
  return nullptr;
}

std::string paper_markdown(const Paper& paper, const BenchResult& result) {
  std::string text = std::string(paper.source) + ".\nPublished on " + paper.machine +
                     ".\nHere: " + result.driver + ", " + std::to_string(result.width_px) + " x " +
                     std::to_string(result.height_px) + ".\n\n";
  text +=
      "| setting | published frames/s | its speed, first row 1 | published error | method here | "
      "median ms | core ms | its speed by core ms, first row 1 | ours / published | % over 1 px | "
      "mean px | max px | "
      "wrong class | % ray cast | steps a px, nodes + cells |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  const PaperRow& first = paper.rows.front();
  for (const PaperRow& row : paper.rows) {
    text += std::string("| ") + row.setting + " | " + (row.fps ? number("%g", *row.fps) : "–") +
            " | " + or_dash(published_ratio(row, first)) + " | " +
            (*row.error != '\0' ? row.error : "–") + " | " + row.spec + " | " +
            our_cells(result, row, first) + "\n";
  }
  return text + "\n" + paper.remark + "\n";
}

}  // namespace ridgeline::sim
