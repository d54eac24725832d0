// Copies one C++ source with all its mutants in it, each behind a switch.
// Usage: ridgeline-mutate TREE FILE COPY      FILE from the root of the tree.
#include <fstream>
#include <iostream>
#include <sstream>

#include "tests/mutants/mutant.hpp"

namespace {

/// The shaders reach the renderer through this text; mutants of GLSL are put in on the way.
std::string with_shader_hook(std::string text) {
  const std::string hook = "::ridgeline::test::mutated_shader(";
  for (const char* name : {"shader::sweep_comp", "shader::count_comp", "shader::ray_cast_frag"}) {
    const std::size_t at = text.find(name);
    if (at == std::string::npos) continue;
    text.replace(at, std::string(name).size(), hook + name + ")");
  }
  return text;
}

}  // namespace

int main(int count, char** words) {
  if (count != 4) {
    std::cerr << "usage: ridgeline-mutate TREE FILE COPY\n";
    return 2;
  }
  const std::string path = std::string(words[1]) + "/" + words[2];
  std::ifstream source(path);
  std::ostringstream text;
  text << source.rdbuf();
  if (!source || text.str().empty()) {
    std::cerr << path << ": cannot be read\n";
    return 3;
  }
  std::ofstream copy(words[3]);
  copy << "// A copy of " << words[2] << " with every mutant behind a switch.\n"
       << "#include \"tests/mutants/active.hpp\"\n#line 1 \"" << words[2] << "\"\n"
       << ridgeline::test::with_switches(words[2], with_shader_hook(text.str()));
  copy.close();
  if (!copy) std::cerr << words[3] << ": cannot be written\n";
  return copy ? 0 : 3;
}
