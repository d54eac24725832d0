// Which format a log is in, told by its content. An input is the text of a log.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sim/log/candump_reader.hpp"
#include "tests/fuzz/input_bytes.hpp"
#include "tests/fuzz/property.hpp"

using ridgeline::CandumpReader;
using ridgeline::CandumpStatistics;
using ridgeline::LogFormat;
using ridgeline::fuzz::must;

namespace {

CandumpStatistics counts_of(std::string_view text, LogFormat format) {
  CandumpReader reader = CandumpReader::over(text, "log", {format, true});
  while (reader.next()) {
  }
  return reader.statistics();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = ridgeline::fuzz::InputBytes(data, size).text();
  const LogFormat told = ridgeline::log_format(text, "log");
  must(told != LogFormat::by_content, "the format is one");
  const LogFormat by_name = ridgeline::log_format(text, "log.Trc");
  must(by_name == told || (told == LogFormat::candump && by_name == LogFormat::peak_trc),
       "the name counts only where the content says nothing");
  must(counts_of(text, LogFormat::by_content) == counts_of(text, told),
       "a log is read as what its content says");
  return 0;
}
