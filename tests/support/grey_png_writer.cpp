#include "tests/support/grey_png_writer.hpp"

#include <gdal.h>

#include <vector>

#include "core/base/assert.hpp"

namespace ridgeline::test {

void write_grey_png(const std::string& path, int columns, int rows, int bits,
                    const std::function<double(int, int)>& value) {
  GDALAllRegister();
  const GDALDatasetH memory = GDALCreate(GDALGetDriverByName("MEM"), "", columns, rows, 1,
                                         bits == 16 ? GDT_UInt16 : GDT_Byte, nullptr);
  RL_ASSERT(memory != nullptr);
  std::vector<double> line(static_cast<std::size_t>(columns));
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) line[static_cast<std::size_t>(c)] = value(c, r);
    RL_ASSERT(GDALRasterIO(GDALGetRasterBand(memory, 1), GF_Write, 0, r, columns, 1, line.data(),
                           columns, 1, GDT_Float64, 0, 0) == CE_None);
  }
  const GDALDatasetH png = GDALCreateCopy(GDALGetDriverByName("PNG"), path.c_str(), memory, 0,
                                          nullptr, nullptr, nullptr);
  RL_ASSERT(png != nullptr);
  GDALClose(png);
  GDALClose(memory);
}

}  // namespace ridgeline::test
