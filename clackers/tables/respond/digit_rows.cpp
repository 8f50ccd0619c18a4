#include "clackers/tables/respond.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clackers/exact/certified/digits.hpp"

namespace clackers::tables {
namespace {

using certified::Digits;

// The rows of a source in double precision, their real numbers replaced. What rows there are, and
// which side each is of, is decided once.
class DigitRows : public record::RowSource {
 public:
  // `about` is the number of rows, second rows at impacts left out.
  DigitRows(const cases::Case& test_case, std::unique_ptr<record::RowSource> rows, long long digits,
            long long about)
      : rows_(std::move(rows)),
        digits_(*test_case.motion, digits),
        columns_(rows_->columns()),
        title_(fmt::format("{}, {} digits", rows_->title(), digits)),
        about_(about) {
    for (auto& column : columns_)
      if (column.kind == record::ColumnKind::real) column.kind = record::ColumnKind::any;
  }

  std::string title() const override { return title_; }
  const std::vector<record::Column>& columns() const override { return columns_; }

  bool next(std::vector<record::Cell>& row) final {
    if (!rows_->next(row)) return false;
    round(row);
    report(std::min(++done_, about_), about_);
    return true;
  }

 protected:
  virtual void round(std::vector<record::Cell>& row) = 0;

  std::unique_ptr<record::RowSource> rows_;
  Digits digits_;
  std::vector<record::Column> columns_;

 private:
  std::string title_;
  long long about_, done_ = 0;
};

class ResponseDigits : public DigitRows {
 public:
  using DigitRows::DigitRows;
  std::string schema() const override { return "clackers/response-digits/1"; }

  void round(std::vector<record::Cell>& row) override {
    const double t = std::get<double>(row[0]);
    const auto* side = std::get_if<std::string>(&row[1]);
    const bool after = side != nullptr && *side == "+";
    const auto now = digits_.at(t, after ? model::Side::right : model::Side::left);
    row[0] = digits_.time(t);
    std::size_t at = 2;
    for (std::size_t i = 0; i < now.u.size(); ++i)
      for (const auto* values : {&now.u, &now.v, &now.a}) row[at++] = (*values)[i];
  }
};

class ImpactDigits : public DigitRows {
 public:
  ImpactDigits(const cases::Case& test_case, std::unique_ptr<record::RowSource> rows,
               long long digits, long long about)
      : DigitRows(test_case, std::move(rows), digits, about) {
    columns_[1].meaning = "its time";
  }
  std::string schema() const override { return "clackers/impacts-digits/1"; }

  void round(std::vector<record::Cell>& row) override {
    const auto hit = digits_.impact(std::get<long long>(row[0]));
    row[1] = hit.t;
    std::size_t at = columns_[2].name == "contact" ? 3 : 2;
    for (std::size_t i = 0; i < hit.before.v.size(); ++i) {
      if (columns_[at].name.front() == 'u') row[at++] = hit.before.u[i];
      row[at++] = hit.before.v[i];
      row[at++] = hit.after.v[i];
    }
    for (const auto* value : {&hit.impulse, &hit.energy_before, &hit.energy_after})
      row[at++] = *value;
  }
};

}  // namespace

std::unique_ptr<record::RowSource> respond(const cases::Case& test_case, const TimeGrid& grid,
                                           long long digits) {
  return std::make_unique<ResponseDigits>(test_case, respond(test_case, grid), digits, grid.size());
}

std::unique_ptr<record::RowSource> impacts(const cases::Case& test_case, long long digits) {
  return std::make_unique<ImpactDigits>(test_case, impacts(test_case), digits,
                                        test_case.motion->impact_count(test_case.motion->end()));
}

}  // namespace clackers::tables
