// Built with exceptions and RTTI on purpose: check_symbols has to refuse it (see CMakeLists.txt).
namespace ridgeline {

struct Base {
  virtual ~Base() = default;
};
struct Derived : Base {};

int throws_at(Base* base) {
  if (dynamic_cast<Derived*>(base) == nullptr) throw 1;
  return 0;
}

}  // namespace ridgeline
