#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"
#include "clackers/tables/respond.hpp"

namespace clackers::python {
namespace {

using cases::Case;

// More are asked for by range: a motion may have 3e8 impacts.
constexpr long long most_unasked = 1'000'000;

// The arrays of clackers.Impacts, filled row by row.
class ImpactArrays {
 public:
  ImpactArrays(py::ssize_t count, py::ssize_t dof) {
    for (const char* name : {"t", "t_lo", "t_hi", "impulse", "energy_before", "energy_after"})
      numbers_.push_back(add(name, Doubles(count)));
    for (const char* name : {"u", "v_before", "v_after", "a_before", "a_after"})
      vectors_.push_back(add(name, Doubles({count, dof})));
    py::array_t<std::int64_t> index(count), contact(count);
    index_ = index.mutable_data();
    contact_ = contact.mutable_data();
    arrays_["index"] = index;
    arrays_["contact"] = contact;
  }

  void append(const model::MotionImpact& now) {
    *index_++ = now.index;
    *contact_++ = now.contact;
    const double numbers[] = {now.t,       now.when.lo,       now.when.hi,
                              now.impulse, now.energy_before, now.energy_after};
    for (std::size_t i = 0; i < numbers_.size(); ++i) *numbers_[i]++ = numbers[i];
    const Eigen::VectorXd* vectors[] = {&now.before.u, &now.before.v, &now.after.v, &now.before.a,
                                        &now.after.a};
    for (std::size_t i = 0; i < vectors_.size(); ++i)
      vectors_[i] = std::copy(vectors[i]->begin(), vectors[i]->end(), vectors_[i]);
  }

  const py::dict& arrays() const { return arrays_; }

 private:
  double* add(const char* name, Doubles array) {
    arrays_[name] = array;
    return array.mutable_data();
  }

  py::dict arrays_;
  std::vector<double*> numbers_, vectors_;
  std::int64_t *index_ = nullptr, *contact_ = nullptr;
};

long long last_impact(py::handle last, long long first, long long total) {
  if (last.is_none()) {
    if (total - first >= most_unasked)
      refuse(
          "impacts", "last", "None",
          fmt::format("a number up to {}, the impacts of this motion", total),
          fmt::format("These are {} impacts; say which, for example impacts(first=1, last=1000).",
                      total - first + 1),
          "too-many-rows");
    return total;
  }
  const auto number = read_whole("impacts", "last", last);
  if (!(number <= total))
    refuse("impacts", "last", fmt::to_string(number),
           fmt::format("last <= {}, the impacts of this motion", total), {}, "beyond-last-impact");
  return number;
}

py::dict impacts(const Case& test_case, py::handle from, py::handle to) {
  const auto& motion = *test_case.motion;
  const auto total = motion.impact_count(motion.end());
  const auto first = read_whole("impacts", "first", from);
  if (first < 1)
    refuse("impacts", "first", fmt::to_string(first), "first >= 1, the number of the first impact");
  const auto last = last_impact(to, first, total);
  if (first > total + 1)
    refuse("impacts", "first", fmt::to_string(first),
           fmt::format("first <= {} + 1, behind the last impact of this motion", total), {},
           "beyond-last-impact");
  if (last < first - 1)
    refuse("impacts", "first", fmt::to_string(first),
           fmt::format("first <= last + 1 = {}", last + 1));
  ImpactArrays arrays(last - first + 1, motion.dof());
  {
    const py::gil_scoped_release without_gil;
    Interrupts interrupts;
    for (long long k = first; k <= last; ++k) {
      arrays.append(motion.impact(k));
      interrupts.check();
    }
  }
  return arrays.arrays();
}

py::tuple impact_table(const Case& test_case) {
  last_impact(py::none(), 1, test_case.motion->impact_count(test_case.motion->end()));
  return read_rows(*tables::impacts(test_case));
}

long long impact_count(const Case& test_case, py::handle t) {
  const auto& motion = *test_case.motion;
  if (t.is_none()) return motion.impact_count(motion.end());
  return motion.impact_count(
      require_inside("impact_count", read_number("impact_count", "t", t), motion.end()));
}

}  // namespace

void bind_impacts(py::module_& core) {
  core.def("impacts", &impacts, py::arg("case"), py::arg("first"), py::arg("last"));
  core.def("impact_table", &impact_table, py::arg("case"));
  core.def("impact_count", &impact_count, py::arg("case"), py::arg("t"));
}

}  // namespace clackers::python
