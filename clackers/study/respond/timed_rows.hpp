#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/study/respond/impact_finder.hpp"
#include "clackers/study/respond.hpp"

namespace clackers::study {

/// The closed form that a case is. Throws InputError, naming what was wanted of it, for a motion of
/// another kind.
const exact::ClosedForm& closed_form(const cases::Case& which, std::string_view wanted);

/// Throws InputError unless every time of the grid lies in [0, end of the case].
void require_inside(const cases::Case& which, const TimeGrid& grid);

/// Rows t, side and more at the times of a grid; two where a time is the double nearest to a
/// collision, sides "-" then "+".
class TimedRows : public RowSource {
 public:
  /// Appends the cells behind t and side.
  using Values = std::function<void(double t, model::Side side, std::vector<Cell>& row)>;

  /// `columns` are those behind t and side. The motion must outlive the rows.
  TimedRows(const model::Motion& motion, const TimeGrid& grid, std::string schema,
            std::string title, const std::vector<Column>& columns, Values values);

  std::string schema() const override { return schema_; }
  std::string title() const override { return title_; }
  const std::vector<Column>& columns() const override { return columns_; }
  bool next(std::vector<Cell>& row) override;

 private:
  void write(std::vector<Cell>& row, const char* sign, model::Side side) const;

  TimeGrid grid_;
  ImpactFinder finder_;
  std::string schema_, title_;
  std::vector<Column> columns_;
  Values values_;
  long long done_ = 0;
  double t_ = 0.0;
  bool right_limit_is_due_ = false;
};

}  // namespace clackers::study
