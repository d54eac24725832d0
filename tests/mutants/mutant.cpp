#include "tests/mutants/mutant.hpp"

namespace ridgeline::test {

const std::vector<Mutant>& mutants() {
  static const std::vector<Mutant> all = [] {
    std::vector<Mutant> joined;
    for (const auto table :
         {shader_mutants(), terrain_mutants(), frame_mutants(), shared_mutants()}) {
      joined.insert(joined.end(), table.begin(), table.end());
    }
    for (const HarmlessMutant& harmless : harmless_mutants()) joined.push_back(harmless.mutant);
    return joined;
  }();
  return all;
}

int count_of(std::string_view text, std::string_view wanted) {
  int count = 0;
  for (auto at = text.find(wanted); at != text.npos; at = text.find(wanted, at + 1)) ++count;
  return count;
}

std::string with_switches(std::string_view file, std::string text) {
  // Of texts that hold one another the longer first: what is right comes first in a choice, so the
  // shorter is found there.
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < mutants().size(); ++k) {
    if (mutants()[k].file != file) continue;
    auto place = order.begin();
    while (place != order.end() && mutants()[*place].find.size() >= mutants()[k].find.size()) {
      ++place;
    }
    order.insert(place, k);
  }
  for (const std::size_t k : order) {
    const Mutant& mutant = mutants()[k];
    const std::size_t at = text.find(mutant.find);
    if (at == std::string::npos) continue;  // the test says so
    const std::string find(mutant.find), put(mutant.put);
    const bool statement = find.ends_with(';') || find.ends_with('}');
    const std::string asked = "::ridgeline::test::mutant_is_on(" + std::to_string(k) + ")";
    text.replace(at, find.size(),
                 statement ? "if (!" + asked + ") { " + find + " } else { " + put + " }"
                           : "(!" + asked + " ? (" + find + ") : (" + put + "))");
  }
  return text;
}

}  // namespace ridgeline::test
