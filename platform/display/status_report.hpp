#pragma once
#include "platform/display/display_config.hpp"
#include "platform/display/exchange.hpp"
#include "platform/display/json_text.hpp"

namespace ridgeline {

/// What a status report is made from; by the one thread that reads these members of the exchange.
struct StatusSources {
  BusStatus bus;
  FrameFact frame;
  LineStatus lines;
};

/// Takes the newest of everything.
void read_sources(Exchange& exchange, StatusSources& sources);

/// Writes the report as JSON (docs/commands.md, section "The flight program"): frames, latency,
/// bus, lines, memory, drops. `why`: what ended the program, or "running".
/// Cost: no allocation; system calls read the process's own memory figures.
void write_status(JsonText& json, const DisplayConfig& config, const Exchange& exchange,
                  const StatusSources& sources, std::int64_t now_ns, const char* why);

}  // namespace ridgeline
