#include "core/bus/arinc429.hpp"

namespace ridgeline {
namespace {

/// Words of 20 bits use the SDI for data, and a fine word must find the coarse word it belongs to.
bool has_sdi(Arinc429Form form) {
  return form != Arinc429Form::bnr20 && form != Arinc429Form::bnr_fine &&
         form != Arinc429Form::bcd_position;
}

std::uint32_t u32_be(const BusFrame& frame) {
  return std::uint32_t{frame.data[0]} << 24 | std::uint32_t{frame.data[1]} << 16 |
         std::uint32_t{frame.data[2]} << 8 | std::uint32_t{frame.data[3]};
}

bool is_gnss_coarse(const Arinc429Row& row) {
  return row.form == Arinc429Form::bnr20 && (row.parameter == BusParameter::gps_latitude ||
                                             row.parameter == BusParameter::gps_longitude);
}

/// Whether a coarse word still waits at `time_ns`.
bool is_waiting(const CoarseWord& pending, std::int64_t time_ns, const Arinc429Profile& profile) {
  const std::int64_t gap_ns = time_ns - pending.time_ns;
  return pending.pending && gap_ns >= 0 && gap_ns <= profile.fine_pair_limit_ns;
}

/// A coarse word: remembered until its fine word comes, or the value where the source has none.
Arinc429Step coarse_step(const CoarseWord& pending, const Arinc429Reading& reading,
                         std::int64_t time_ns, const Arinc429Profile& profile) {
  Arinc429Step step;
  if (profile.fine_rule == FineRule::coarse_alone) {
    step.value = bnr20_value(reading.word.bits, reading.row->range);
    return step;
  }
  const bool waits = is_waiting(pending, time_ns, profile);
  step.unpaired = pending.pending;
  // Two receivers in step would push each other's coarse words out for ever: the first one stays.
  if (waits && pending.source != reading.source) {
    step.next = pending;
    return step;
  }
  step.next.pending = true;
  step.next.changed = waits && (pending.changed || pending.bits != reading.word.bits);
  step.next.bits = reading.word.bits;
  step.next.time_ns = time_ns;
  step.next.source = reading.source;
  return step;
}

/// A fine word: completes the coarse word before it.
Arinc429Step fine_step(const CoarseWord& pending, const Arinc429Reading& reading,
                       std::int64_t time_ns, const Arinc429Profile& profile) {
  Arinc429Step step;
  const bool waits = is_waiting(pending, time_ns, profile);
  const bool is_mine = waits && pending.source == reading.source;
  if (waits && !is_mine) step.next = pending;
  if (!is_mine || pending.changed) {
    step.unpaired = pending.pending && !step.next.pending;
    step.fault = Fault::bus_unpaired;
    return step;
  }
  const Result<std::uint32_t> units = bnr_fine_units(reading.word.bits);
  if (!units) {
    step.unpaired = true;
    step.fault = units.fault();
    return step;
  }
  constexpr double half_turn_units = 2147483648.0;
  constexpr double coarse_range_deg = 180.0;
  const double coarse_deg = bnr20_value(pending.bits, coarse_range_deg);
  const double fine_deg = units.value() * coarse_range_deg / half_turn_units;
  const bool is_away = profile.fine_rule == FineRule::by_coarse_sign && coarse_deg < 0.0;
  step.value = is_away ? coarse_deg - fine_deg : coarse_deg + fine_deg;
  return step;
}

Result<double> single_value(const Arinc429Row& row, const Arinc429Word& word) {
  switch (row.form) {
    case Arinc429Form::bnr:
      return bnr_value(word.bits, row.range, row.significant_bits) * row.unit_factor;
    case Arinc429Form::bnr20:
      return bnr20_value(word.bits, row.range) * row.unit_factor;
    case Arinc429Form::utc_word:
      return utc_word_s(word.bits);
    case Arinc429Form::date_word:
      if (arinc429_status(row.form, word.ssm) == Arinc429Status::minus) {
        return Fault::bus_value_out_of_range;
      }
      return date_word_days(word.bits);
    case Arinc429Form::bcd_position:
      return Fault::bus_resolution;
    case Arinc429Form::bcd: {
      const Result<std::uint32_t> digits = bcd_digits(word.bits);
      if (!digits) return digits.fault();
      const bool minus = arinc429_status(row.form, word.ssm) == Arinc429Status::minus;
      return (minus ? -1.0 : 1.0) * digits.value() * row.unit_factor;
    }
    case Arinc429Form::bnr_fine:
    case Arinc429Form::discrete:
      break;
  }
  return Fault::bus_type_mismatch;
}

}  // namespace

Result<Arinc429Reading> arinc429_reading(const BusFrame& frame, const Arinc429Profile& profile) {
  if (frame.error || frame.remote) return Fault::bus_not_data;
  if (frame.fd) return Fault::bus_not_classic;
  const bool is_port = frame.extended && frame.id >= profile.id_base &&
                       frame.id - profile.id_base < arinc429_port_count;
  if (!is_port) return Fault::bus_id_unknown;
  Arinc429Reading reading;
  reading.port = static_cast<std::uint8_t>(frame.id - profile.id_base);
  const Arinc429Port& port = profile.ports[reading.port];
  if (port.equipment == 0) return Fault::bus_id_unknown;
  if (frame.length != 4) return Fault::bus_length;
  const Result<Arinc429Word> word = arinc429_word(u32_be(frame), profile.label_order);
  if (!word) return word.fault();
  reading.word = word.value();
  reading.row = arinc429_row(reading.word.label, port.equipment);
  if (reading.row == nullptr) return Fault::bus_id_unknown;
  reading.source = {frame.interface, 0, reading.port};
  if (has_sdi(reading.row->form)) {
    if (port.sdi && *port.sdi != reading.word.sdi) return Fault::bus_id_unknown;
    reading.source.node_id = reading.word.sdi;
  }
  return reading;
}

Arinc429Step arinc429_value(const CoarseWord& pending, const Arinc429Reading& reading,
                            std::int64_t time_ns, const Arinc429Profile& profile) {
  RL_ASSERT(reading.row != nullptr);
  const Arinc429Row& row = *reading.row;
  Arinc429Step step;
  step.fault = fault_of_status(arinc429_status(row.form, reading.word.ssm));
  if (step.fault != Fault::none) {
    // Half of a value that its sender disowns: the other half is worth nothing either.
    const bool is_half = is_gnss_coarse(row) || row.form == Arinc429Form::bnr_fine;
    const bool gives_up = is_half && pending.pending && pending.source == reading.source;
    step.unpaired = gives_up;
    if (!gives_up) step.next = pending;
    return step;
  }
  if (is_gnss_coarse(row)) return coarse_step(pending, reading, time_ns, profile);
  if (row.form == Arinc429Form::bnr_fine) return fine_step(pending, reading, time_ns, profile);
  step.next = pending;
  const Result<double> value = single_value(row, reading.word);
  if (value) {
    step.value = value.value();
  } else {
    step.fault = value.fault();
  }
  return step;
}

}  // namespace ridgeline
