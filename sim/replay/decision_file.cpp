#include "sim/replay/decision_file.hpp"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

namespace ridgeline::sim {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_word = "ridgeline decisions 1";
constexpr std::array<const char*, 3> verdict_words = {"go_on", "coarser", "give_up"};

const char* verdict_word(LateVerdict verdict) {
  return verdict_words[static_cast<std::size_t>(verdict)];
}

FrameStage stage_of(const std::string& word) {
  for (std::size_t k = 0; k < frame_stage_count; ++k) {
    if (word == stage_word(static_cast<FrameStage>(k))) return static_cast<FrameStage>(k);
  }
  throw Json::other_error::create(501, "no stage is called '" + word + "'", nullptr);
}

LateVerdict verdict_of(const std::string& word) {
  for (std::size_t k = 0; k < verdict_words.size(); ++k) {
    if (word == verdict_words[k]) return static_cast<LateVerdict>(k);
  }
  throw Json::other_error::create(501, "no verdict is called '" + word + "'", nullptr);
}

BudgetSettings settings_of(const Json& head) {
  if (head.at("format") != format_word) {
    throw Json::other_error::create(501, "the format is not '" + std::string(format_word) + "'",
                                    nullptr);
  }
  BudgetSettings settings{head.at("deadline_ns").get<std::int64_t>(),
                          head.at("wanted_px").get<double>(), head.at("most_px").get<double>()};
  const bool within = settings.deadline_ns >= limits::min_deadline_ns &&
                      settings.deadline_ns <= limits::max_deadline_ns && settings.wanted_px > 0 &&
                      settings.most_px > 0;
  if (!within) throw Json::other_error::create(501, "a setting is out of range", nullptr);
  return settings;
}

FrameDecisions frame_of(const Json& json, std::size_t index) {
  if (json.at("frame").get<std::size_t>() != index) {
    throw Json::other_error::create(501, "frame " + std::to_string(index) + " is expected",
                                    nullptr);
  }
  FrameDecisions frame;
  frame.time_ns = json.at("time_ns").get<std::int64_t>();
  frame.record.plan.step = json.at("step").get<int>();
  for (const Json& count : json.at("blocks")) {
    if (!frame.blocks.push_back(count.get<int>())) {
      throw Json::other_error::create(501, "too many rounds of blocks", nullptr);
    }
  }
  for (const Json& reading : json.at("readings")) {
    const bool room = frame.record.readings.push_back(
        {stage_of(reading.at(0).get<std::string>()), reading.at(1).get<std::int64_t>(),
         verdict_of(reading.at(2).get<std::string>())});
    if (!room) throw Json::other_error::create(501, "too many readings", nullptr);
  }
  return frame;
}

}  // namespace

std::string decisions_head(const BudgetSettings& settings, const std::string& arrival) {
  const Json json = {{"format", format_word},
                     {"deadline_ns", settings.deadline_ns},
                     {"wanted_px", settings.wanted_px},
                     {"most_px", settings.most_px},
                     {"arrival", arrival}};
  return json.dump() + "\n";
}

std::string decisions_line(int index, const FrameDecisions& frame) {
  Json json;
  json["frame"] = index;
  json["time_ns"] = frame.time_ns;
  json["step"] = frame.record.plan.step;
  json["error_px"] = frame.record.plan.error_px;
  json["blocks"] = Json::array();
  for (const int count : frame.blocks) json["blocks"].push_back(count);
  json["readings"] = Json::array();
  for (const PaceReading& reading : frame.record.readings) {
    json["readings"].push_back(
        {stage_word(reading.stage), reading.elapsed_ns, verdict_word(reading.verdict)});
  }
  return json.dump() + "\n";
}

Outcome read_decisions(const std::string& path, Decisions& decisions) {
  std::ifstream file(path);
  if (!file) return failed(Fault::file_unreadable, path);
  int number = 0;
  bool has_head = false;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty()) continue;
    try {
      const Json json = Json::parse(line);
      if (has_head) {
        decisions.frames.push_back(frame_of(json, decisions.frames.size()));
        decisions.frames.back().line = number;
      } else {
        decisions.settings = settings_of(json);
        decisions.arrival = json.at("arrival").get<std::string>();
        has_head = true;
      }
    } catch (const Json::exception& error) {
      return {Fault::file_malformed,
              path + ":" + std::to_string(number) + ": not what a run recorded: " + error.what()};
    }
  }
  if (file.bad()) return failed(Fault::file_unreadable, path);
  if (!has_head) return failed(Fault::file_malformed, path, "it is empty");
  return {};
}

std::int64_t RecordedClock::elapsed_ns(FrameStage /*stage*/, const FrameWork& /*done*/,
                                       ShadeDetail /*detail*/) {
  if (record_.readings.empty()) return 0;
  const std::size_t last = record_.readings.size() - 1;
  const std::size_t now = std::min(next_, last);
  ++next_;
  return record_.readings[now].elapsed_ns;
}

bool same_decisions(const PaceRecord& a, const PaceRecord& b) {
  if (a.plan.step != b.plan.step || a.readings.size() != b.readings.size()) return false;
  for (std::size_t k = 0; k < a.readings.size(); ++k) {
    if (a.readings[k].stage != b.readings[k].stage ||
        a.readings[k].verdict != b.readings[k].verdict) {
      return false;
    }
  }
  return true;
}

}  // namespace ridgeline::sim
