#pragma once
#include <cstdint>
#include <optional>

#include "core/bus/arinc429_word.hpp"
#include "core/bus/bus_frame.hpp"
#include "core/bus/bus_value.hpp"

namespace ridgeline {

/// One word with where it came from and what the table makes of its label there.
struct Arinc429Reading {
  Arinc429Word word;
  std::uint8_t port = 0;
  const Arinc429Row* row = nullptr;
  Source source;  ///< channel: the port; node: the SDI, 0 for the words that make positions
};

/// The word in a frame of the convention (docs/icd.md): 29-bit identifier id_base + port, four data
/// bytes, the byte with the parity bit first.
/// Domain: classic data frame, else bus_not_data or bus_not_classic; id of a port with equipment, a
/// label the display reads from that equipment and an SDI it reads there, else bus_id_unknown; four
/// bytes, else bus_length; odd parity, else bus_parity.
[[nodiscard]] Result<Arinc429Reading> arinc429_reading(const BusFrame& frame,
                                                       const Arinc429Profile& profile);

/// A coarse position word that waits for its fine word. Trivially copyable.
struct CoarseWord {
  bool pending = false;
  bool changed = false;    ///< a different coarse word came before any fine one
  std::uint32_t bits = 0;  ///< of the coarse word
  std::int64_t time_ns = 0;
  Source source;
};

/// What one more word led to.
struct Arinc429Step {
  CoarseWord next;
  Fault fault = Fault::none;
  std::optional<double> value;  ///< in the parameter's unit, not yet range-checked
  bool unpaired = false;        ///< a coarse word was given up without its fine one
};

/// The value of a word, or half of it. A GNSS position is a coarse word and, at most
/// `fine_pair_limit_ns` later, a fine word of the same port; each is used once. A fine word after
/// two different coarse words in a row may belong to either, and is refused. A waiting coarse word
/// is not pushed out by one of another source.
/// Domain: SSM of its form says normal, else bus_no_computed_data, bus_functional_test or
/// bus_failure_warning; digits, else bus_digit; a value of its field, else bus_value_out_of_range;
/// a fine word with its coarse one, else bus_unpaired. A BCD position resolves 185 m:
/// bus_resolution. Cost:   O(1); no allocation. `pending` is that of the row's parameter.
[[nodiscard]] Arinc429Step arinc429_value(const CoarseWord& pending, const Arinc429Reading& reading,
                                          std::int64_t time_ns, const Arinc429Profile& profile);

}  // namespace ridgeline
