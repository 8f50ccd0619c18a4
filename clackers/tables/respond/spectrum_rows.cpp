#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "clackers/base/error.hpp"
#include "clackers/exact/quantities/spectrum.hpp"
#include "clackers/tables/times/timed_rows.hpp"

namespace clackers::tables {
namespace {

class SpectrumRows : public record::NumberRows {
 public:
  SpectrumRows(const exact::ClosedForm& motion, const std::string& name, const TimeGrid& grid)
      : spectrum_(motion), dof_(std::size_t(motion.dof())), name_(name), grid_(grid) {
    columns_.push_back({"omega", "rad/s", "frequency", record::ColumnKind::real});
    for (std::size_t i = 1; i <= dof_; ++i) {
      const auto what = fmt::format("part of the integral of u{} exp(-i omega t) over the run", i);
      columns_.push_back({fmt::format("re{}", i), "m s", "real " + what, record::ColumnKind::real});
      columns_.push_back(
          {fmt::format("im{}", i), "m s", "imaginary " + what, record::ColumnKind::real});
    }
  }

  std::string schema() const override { return "clackers/spectrum/1"; }
  std::string title() const override { return "Fourier transform of " + name_ + " over its run"; }
  const std::vector<record::Column>& columns() const override { return columns_; }

  long long count() const override { return grid_.size(); }

  bool next_block(std::vector<double>& values) override {
    constexpr long long block = 64;
    values.clear();
    for (const auto end = std::min(done_ + block, grid_.size()); done_ < end; ++done_) {
      const double omega = grid_.at(done_);
      const auto transform = spectrum_.at(omega);
      values.push_back(omega);
      for (std::size_t i = 0; i < dof_; ++i) {
        values.push_back(transform[i].real());
        values.push_back(transform[i].imag());
      }
    }
    if (!values.empty()) report(done_, grid_.size());
    return !values.empty();
  }

 private:
  exact::Spectrum spectrum_;
  std::size_t dof_;
  std::string name_;
  TimeGrid grid_;
  std::vector<record::Column> columns_;
  long long done_ = 0;
};

}  // namespace

std::unique_ptr<record::RowSource> spectrum(const cases::Case& test_case, long long n,
                                            double highest) {
  const auto& motion = closed_form(test_case, "the spectrum");
  const double limit = exact::Spectrum::most_radians / motion.end();
  if (!(highest > 0.0 && highest <= limit))
    refuse("respond", "highest", highest, fmt::format("0 < highest <= {:.6g} rad/s", limit),
           highest > 0.0 ? "Beyond, the phase at the end of the run is not certain." : "");
  return std::make_unique<SpectrumRows>(motion, test_case.entry->name, grid_of(n, highest));
}

}  // namespace clackers::tables
