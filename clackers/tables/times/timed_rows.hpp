#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/exact/pair/closed_form.hpp"
#include "clackers/model/motion.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::tables {

/// Answers whether a time is the double nearest to an impact. Remembers the two impacts around the
/// last time asked for, so that ascending times cost next to nothing.
class ImpactFinder {
 public:
  /// The motion must outlive the finder.
  explicit ImpactFinder(const model::Motion& motion);

  /// True where `t` [s], within [0, end of the motion], is the double nearest to an impact.
  bool is_impact(double t);

 private:
  double time_of(long long index) const;  // infinite outside 1 ... total_

  const model::Motion& motion_;
  long long total_;
  double before_, after_;  // neighbouring impacts, none between them
};

/// The closed form of a case. Throws InputError, naming the quantity that needs it, for a motion of
/// another kind.
const exact::ClosedForm& closed_form(const cases::Case& test_case, std::string_view wanted);

/// Throws InputError unless every time of the grid lies in [0, end of the case].
void require_inside(const cases::Case& test_case, const TimeGrid& grid);

/// Rows t, side and more at the times of a grid; two where a time is the double nearest to an
/// impact, sides "-" then "+".
class TimedRows : public record::NumberRows {
 public:
  /// Writes the values of the columns after t and side at `times` to rows that lie `stride` doubles
  /// apart, the first at `row`.
  using Fill = std::function<void(std::span<const double> times, model::Side side, double* row,
                                  std::size_t stride)>;

  /// `columns` are those after t and side. `block` times are evaluated together. The motion must
  /// outlive the rows.
  TimedRows(const model::Motion& motion, const TimeGrid& grid, std::string schema,
            std::string title, const std::vector<record::Column>& columns, std::size_t block,
            Fill fill);

  std::string schema() const override { return schema_; }
  std::string title() const override { return title_; }
  const std::vector<record::Column>& columns() const override { return columns_; }
  long long count() const override;
  bool next_block(std::vector<double>& values) override;

 private:
  const model::Motion& motion_;
  TimeGrid grid_;
  ImpactFinder finder_;
  std::string schema_, title_;
  std::vector<record::Column> columns_;
  std::size_t block_;
  Fill fill_;
  long long done_ = 0;
  std::vector<double> times_;
  std::vector<std::size_t> impacts_;  // places in times_
};

/// A fill that evaluates one time after another: `values(t, side, row)`.
TimedRows::Fill one_by_one(auto values) {
  return
      [values](std::span<const double> times, model::Side side, double* row, std::size_t stride) {
        for (const double t : times) {
          values(t, side, row);
          row += stride;
        }
      };
}

}  // namespace clackers::tables
