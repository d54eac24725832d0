#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeline::test {

/// One ingredient of the renderer broken on purpose: a text of one of its sources, and what stands
/// there instead. The sources themselves know nothing of it. Copies of them are compiled for the
/// mutant test alone, with every break in them behind a switch (tests/mutants/mutate.cpp); GLSL is
/// changed before the driver compiles it.
struct Mutant {
  std::string_view name;
  std::string_view file;  ///< from the root of the tree
  std::string_view find;  ///< stands in the file exactly once
  std::string_view put;
  std::string_view breaks;  ///< what is broken, in a few words
  std::string_view scene;   ///< the designed scene that kills it (tests/mutants/scenes.hpp)
};

/// A break that no frame can show, and why. It is drawn and judged as any other, in the scene where
/// it should show first, and must be sound there.
struct HarmlessMutant {
  Mutant mutant;
  std::string_view reason;
};

/// All of them, those of the shaders first, the harmless ones last. Index: what set_active_mutant()
/// takes.
[[nodiscard]] const std::vector<Mutant>& mutants();
[[nodiscard]] const std::vector<HarmlessMutant>& harmless_mutants();

/// The tables that mutants() joins, one a source.
[[nodiscard]] std::span<const Mutant> shader_mutants();
[[nodiscard]] std::span<const Mutant> terrain_mutants();
[[nodiscard]] std::span<const Mutant> frame_mutants();
[[nodiscard]] std::span<const Mutant> shared_mutants();

/// How often a text stands in another, overlaps included.
[[nodiscard]] int count_of(std::string_view text, std::string_view wanted);

/// A C++ source with every mutant of `file` in it, each behind mutant_is_on(its index): an
/// expression becomes a choice of two, a statement (that ends with `;` or `}`) an if.
[[nodiscard]] std::string with_switches(std::string_view file, std::string text);

}  // namespace ridgeline::test
