#include "platform/gpio_lines.hpp"

#include <utility>

namespace ridgeline {

Result<GpioLines> GpioLines::open(const GpioSettings& settings, std::int64_t now_ns,
                                  const char*& refused) {
  GpioLines made;
  made.hold_ns_ = settings.hold_ns;
  for (std::size_t i = 0; i < discrete_output_count; ++i) {
    const DiscreteSettings& wanted = settings.outputs[i];
    refused = wanted.name;
    if (*wanted.name == '\0') continue;
    Result<GpioLine> line = GpioLine::open({wanted.name, wanted.active_low, true, boot_levels[i]});
    if (!line) return line.fault();
    made.output_lines_[i] = std::move(line).value();
  }
  for (std::size_t i = 0; i < discrete_input_count; ++i) {
    const DiscreteSettings& wanted = settings.inputs[i];
    refused = wanted.name;
    made.inputs_[i] = debounce_from(settings.defaults[i], now_ns);
    if (*wanted.name == '\0') continue;
    Result<GpioLine> line = GpioLine::open({wanted.name, wanted.active_low, false, false});
    if (!line) return line.fault();
    const Result<bool> level = line.value().level();
    if (!level) return level.fault();
    made.inputs_[i] = debounce_from(level.value(), now_ns);
    made.input_lines_[i] = std::move(line).value();
  }
  refused = "";
  return made;
}

Fault GpioLines::lose() {
  if (line_lost_) return Fault::none;
  line_lost_ = true;
  // What can still be set is set at once; another lost line changes nothing more.
  static_cast<void>(put(driven_levels(present_, present_, true)));
  return Fault::gpio_line_lost;
}

Status GpioLines::read(std::int64_t now_ns) {
  bool all_read = true;
  for (std::size_t i = 0; i < discrete_input_count; ++i) {
    if (!input_lines_[i]) continue;
    const Result<bool> level = input_lines_[i]->level();
    if (level) {
      inputs_[i] = debounced(inputs_[i], level.value(), now_ns, hold_ns_);
    } else {
      all_read = false;
    }
  }
  return all_read ? Status{} : Status{lose()};
}

bool GpioLines::put(const OutputLevels& levels) {
  bool all_set = true;
  for (std::size_t i = 0; i < discrete_output_count; ++i) {
    if (levels[i] == present_[i]) continue;
    if (output_lines_[i] && !output_lines_[i]->set_level(levels[i])) {
      all_set = false;
    } else {
      present_[i] = levels[i];
    }
  }
  return all_set;
}

Status GpioLines::write(const OutputLevels& wanted) {
  return put(driven_levels(wanted, present_, line_lost_)) ? Status{} : Status{lose()};
}

}  // namespace ridgeline
