#pragma once
#include <functional>
#include <string>

namespace ridgeline::test {

/// Writes a grey PNG of 8 or 16 bits, or aborts the test program. value(column, row), row 0 on top.
void write_grey_png(const std::string& path, int columns, int rows, int bits,
                    const std::function<double(int, int)>& value);

}  // namespace ridgeline::test
