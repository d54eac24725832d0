#pragma once
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace ridgeline::test {

/// How one run of the program ended and what it said.
struct Ended {
  int status = -1;  ///< exit status; -1 when a signal ended it
  std::string out, err;

  [[nodiscard]] int error_lines() const;
  [[nodiscard]] bool says(const std::string& text) const {
    return err.find(text) != std::string::npos;
  }
};

/// Runs `ridgeline` with these arguments; `environment` such as "LP_NUM_THREADS=1" comes first.
Ended ridgeline(const std::vector<std::string>& arguments, const std::string& environment = "");

/// Expects this exit status and one line on standard error that holds every one of `words`.
void expect_one_line(const Ended& ended, int status, const std::vector<std::string>& words);

void write_text(const std::string& path, const std::string& text);
std::string text_of(const std::string& path);

/// The bus log of 2 s of level flight at 700 m and 60 m/s from a place; its time begins at
/// 1,700,000,000 s.
std::string level_flight(double latitude_deg, double longitude_deg, double heading_deg);

/// A folder with one small tile (flat, 100 m) and a log of 2 s of level flight over it.
class FlatScene {
 public:
  FlatScene();
  [[nodiscard]] std::string tiles() const { return folder_.file("tiles"); }
  [[nodiscard]] std::string log() const { return folder_.file("flight.log"); }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  /// Arguments of a small pose over the tile; `more` replaces options of the same name.
  [[nodiscard]] std::vector<std::string> pose(const std::vector<std::string>& more = {}) const;
  [[nodiscard]] std::vector<std::string> replay(const std::vector<std::string>& more = {}) const;

 private:
  TemporaryFolder folder_;
};

}  // namespace ridgeline::test
