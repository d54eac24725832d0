#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "platform/display/flight_log.hpp"
#include "platform/display/json_text.hpp"
#include "platform/display/log_thread.hpp"
#include "platform/heap_counter.hpp"
#include "platform/real_time.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeline {
namespace {

std::string line_of(const LogRecord& record, bool for_journal) {
  std::array<char, 256> line{};
  const int length = log_line(record, for_journal, line);
  return {line.data(), static_cast<std::size_t>(length)};
}

TEST(FlightLog, a_line_has_time_level_and_text) {
  LogRing log;
  log.tell(LogLevel::caution, "bus %s: %d", "can0", 7);
  LogRecord record;
  ASSERT_TRUE(log.pop(record));
  EXPECT_GT(record.time_ns, 0);
  record.time_ns = 12'345'678'901;
  EXPECT_EQ(line_of(record, false), "12.345678 s: bus can0: 7");
  EXPECT_EQ(line_of(record, true), "<4>12.345678 s: bus can0: 7");
  EXPECT_FALSE(log.pop(record));
}

TEST(FlightLog, a_full_ring_drops_and_counts_and_a_long_text_is_cut) {
  LogRing log;
  const std::string text(1'000, 'x');
  const std::uint64_t before = heap_allocations_counted();
  {
    const HeapSection section;
    for (int i = 0; i < 200; ++i) log.tell(LogLevel::note, "%d %s", i, text.c_str());
  }
  EXPECT_EQ(heap_allocations_counted(), before);
  EXPECT_EQ(log.dropped_count(), 72u);
  LogRecord record;
  int lines = 0;
  while (log.pop(record)) ++lines;
  EXPECT_EQ(lines, 128);
  EXPECT_LT(line_of(record, true).size(), 256u);
}

TEST(FlightLog, a_picture_is_told_by_mode_and_reasons_as_far_as_there_is_room) {
  Availability seen;
  EXPECT_STREQ(picture_words(seen).data(), mode_word(seen.mode).data());
  seen.mode = Mode::removed;
  seen.reasons.push_back(Reason::attitude_stale);
  seen.reasons.push_back(Reason::heading_stale);
  EXPECT_STREQ(picture_words(seen).data(), "removed attitude_stale heading_stale");
  while (seen.reasons.push_back(Reason::heading_reference_unknown)) {
  }
  const std::string all = picture_words(seen).data();
  EXPECT_EQ(all.size(), 127u);
  EXPECT_EQ(all.rfind("removed attitude_stale heading_stale heading_reference_unknown ", 0), 0u);
}

/// What SIGUSR1 asks for; the signal itself is rig.display's.
TEST(StatusFile, is_written_once_for_each_time_it_is_asked_for) {
  const test::ScratchFolder folder("status_file");
  DisplayConfig config;
  config.report.status_file = folder.file("status.json");
  config.report.status_interval_s = 0;
  const auto exchange = std::make_unique<Exchange>();
  const auto log = std::make_unique<LogThread>(config, *exchange);
  const auto round = [&] {
    std::filesystem::remove(config.report.status_file);
    const HeapSection section;
    log->round(monotonic_now_ns());
  };
  const auto is_there = [&] { return std::filesystem::exists(config.report.status_file); };
  round();
  EXPECT_FALSE(is_there()) << "nobody asked";
  for (int asked = 0; asked < 2; ++asked) {
    exchange->want_status = true;
    round();
    ASSERT_TRUE(is_there());
    const auto bytes = test::bytes_of(config.report.status_file);
    const std::string text(bytes.begin(), bytes.end());
    EXPECT_NE(text.find("\"state\": \"running\""), std::string::npos) << text.substr(0, 80);
    round();
    EXPECT_FALSE(is_there()) << "one report for one question";
  }
  EXPECT_FALSE(std::filesystem::exists(config.report.status_file + ".new"));
}

TEST(JsonText, objects_and_lists_nest_and_texts_are_escaped) {
  auto json = std::make_unique<JsonText>();
  json->open_object();
  json->add("a", 1.5);
  json->open_list("b");
  json->add(nullptr, true);
  json->add(nullptr, std::uint64_t{7});
  json->add(nullptr, std::int64_t{-7});
  json->close_list();
  json->add("c", "x\"\\\n");
  json->add("d", 1.0 / 0.0);
  json->close_object();
  EXPECT_TRUE(json->complete());
  EXPECT_EQ(json->text(),
            "{\n \"a\": 1.5,\n \"b\": [\n  true,\n  7,\n  -7],\n \"c\": \"x\\\"\\\\\\u000a\",\n"
            " \"d\": null}\n");
}

TEST(JsonText, what_does_not_fit_is_said) {
  auto json = std::make_unique<JsonText>();
  json->open_list();
  for (int i = 0; i < 10'000; ++i) json->add(nullptr, std::uint64_t{1'000'000});
  json->close_list();
  EXPECT_FALSE(json->complete());
}

}  // namespace
}  // namespace ridgeline
