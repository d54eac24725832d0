#pragma once
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace ridgeline::oracle {

/// Values in rows and columns, row 0 south. A full sheet holds each of them. A bordered one holds
/// its first and last row and column, one value for all places inside, and those inside that were
/// set: far less, where little is set.
/// Domain: at least one row and one column; places are inside.
template <class T>
class Sheet {
 public:
  [[nodiscard]] static Sheet full(int rows, int columns, const T& value) {
    Sheet sheet(rows, columns, value);
    sheet.held_.assign(sheet.index(rows - 1, columns - 1) + 1, value);
    return sheet;
  }
  [[nodiscard]] static Sheet bordered(int rows, int columns, const T& value) {
    Sheet sheet(rows, columns, value);
    sheet.is_full_ = false;
    sheet.held_.assign(2 * (sheet.index(0, columns) + static_cast<std::size_t>(rows)), value);
    return sheet;
  }

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] bool is_full() const { return is_full_; }
  /// The value of all places inside a bordered sheet that were not set.
  [[nodiscard]] const T& inside() const { return inside_; }
  /// How many values are held in memory.
  [[nodiscard]] std::size_t held_count() const { return held_.size() + set_inside_.size(); }

  [[nodiscard]] const T& at(int row, int column) const {
    if (is_full_) return held_[index(row, column)];
    if (is_border(row, column)) return held_[border_index(row, column)];
    if (set_inside_.empty()) return inside_;
    const auto found = set_inside_.find(index(row, column));
    return found == set_inside_.end() ? inside_ : found->second;
  }

  void set(int row, int column, const T& value) {
    if (is_full_) {
      held_[index(row, column)] = value;
    } else if (is_border(row, column)) {
      held_[border_index(row, column)] = value;
    } else {
      set_inside_.insert_or_assign(index(row, column), value);
    }
  }

  /// Calls `take(row, column)` for every place of a full sheet, for the border of another one.
  template <class Take>
  void for_each_held(const Take& take) const {
    for (int row = 0; row < rows_; ++row) {
      const bool is_whole_row = is_full_ || row == 0 || row == rows_ - 1;
      const int step = is_whole_row || columns_ == 1 ? 1 : columns_ - 1;
      for (int column = 0; column < columns_; column += step) take(row, column);
    }
  }

  /// Calls `take(row, column)` for the places inside a bordered sheet that were set, in any order.
  template <class Take>
  void for_each_set_inside(const Take& take) const {
    const auto columns = static_cast<std::size_t>(columns_);
    for (const auto& [place, value] : set_inside_) {
      take(static_cast<int>(place / columns), static_cast<int>(place % columns));
    }
  }

 private:
  Sheet(int rows, int columns, const T& inside) : rows_(rows), columns_(columns), inside_(inside) {}

  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] bool is_border(int row, int column) const {
    return row == 0 || column == 0 || row == rows_ - 1 || column == columns_ - 1;
  }
  /// South row, north row, west column, east column.
  [[nodiscard]] std::size_t border_index(int row, int column) const {
    if (row == 0) return index(0, column);
    if (row == rows_ - 1) return index(1, column);
    const int side = column == 0 ? 0 : rows_;
    return index(2, 0) + static_cast<std::size_t>(side + row);
  }

  int rows_;
  int columns_;
  T inside_;
  bool is_full_ = true;
  std::vector<T> held_;
  std::unordered_map<std::size_t, T> set_inside_;
};

}  // namespace ridgeline::oracle
