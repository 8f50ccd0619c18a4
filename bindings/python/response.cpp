#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <array>
#include <memory>

#include "bindings/python/arguments.hpp"
#include "bindings/python/bind.hpp"
#include "clackers/base/error.hpp"
#include "clackers/cases/case.hpp"

namespace clackers::python {
namespace {

using cases::Case;
using Span = std::span<double>;

// Times between two looks at Ctrl-C: some milliseconds, against some 100 ns to set up a call.
constexpr std::size_t times_together = 65536;

model::Side read_side(py::handle given) {
  const auto side = read_text("response", "side", given);
  if (side == "left") return model::Side::left;
  if (side == "right") return model::Side::right;
  refuse("response", "side", side, "left (before an impact) or right (after it)");
}

// Memory of C++, as std::vector takes it but not written to. NumPy asks the kernel for huge pages from
// 4 MB on, and to get those costs more than the evaluation on some machines.
Doubles new_states(py::ssize_t times, py::ssize_t dof) {
  auto memory = std::make_unique_for_overwrite<double[]>(std::size_t(times * dof));
  const py::capsule owner(memory.get(), [](void* data) { delete[] static_cast<double*>(data); });
  return Doubles({times, dof}, memory.release(), owner);
}

// Where u, v and a go: arrays of the caller, or new ones.
struct Arrays {
  Doubles u, v;
  py::object a;  // None: not wanted

  static Arrays read(const py::object& out, py::ssize_t times, py::ssize_t dof) {
    if (out.is_none()) {
      return {new_states(times, dof), new_states(times, dof), new_states(times, dof)};
    }
    if (!py::isinstance<py::tuple>(out) || py::len(out) != 3)
      refuse("response", "out", description(out), "a tuple of three arrays (u, v, a)",
             "None for a: accelerations are not wanted.");
    const auto given = py::reinterpret_borrow<py::tuple>(out);
    const auto buffer = [&](const char* name, py::handle value) {
      return read_buffer("response", name, value, times, dof);
    };
    return {buffer("u of out", given[0]), buffer("v of out", given[1]),
            given[2].is_none() ? py::none() : py::object(buffer("a of out", given[2]))};
  }

  model::SampleBuffers buffers() {
    model::SampleBuffers to{place_of(u), place_of(v), {}};
    if (!a.is_none()) {
      auto array = py::reinterpret_borrow<Doubles>(a);
      to.a = place_of(array);
    }
    return to;
  }
};

// Times in one dimension; `single`: a number was given, and results have no dimension of time.
struct Times {
  Doubles array;
  bool single;

  Times(std::string_view who, py::handle t)
      : array(read_array(who, "t", t)), single(array.ndim() == 0) {
    if (single) array = array.reshape({1});
    if (array.ndim() != 1)
      refuse(who, "t", description(array), "a number, or one dimension", {}, "wrong-size");
  }
  std::span<const double> values() const { return values_of(array); }
  py::ssize_t size() const { return array.size(); }
};

py::tuple result(const py::object& u, const py::object& v, const py::object& a, bool single) {
  const auto shaped = [&](const py::object& array) -> py::object {
    return single && !array.is_none() ? array[py::int_(0)] : array;
  };
  return py::make_tuple(shaped(u), shaped(v), shaped(a));
}

void refuse_overlap(const Doubles& t, const Arrays& arrays) {
  const auto overlaps = py::module_::import("numpy").attr("may_share_memory");
  for (const py::object& array : {py::object(arrays.u), py::object(arrays.v), arrays.a})
    if (!array.is_none() && overlaps(t, array).cast<bool>())
      refuse("response", "out", "memory of t", "arrays that do not overlap t");
}

Span part(Span all, std::size_t first, std::size_t count) {
  return all.empty() ? all : all.subspan(first, count);
}

py::tuple response(const Case& test_case, py::handle t, py::handle side, const py::object& out) {
  const auto limit = read_side(side);
  const Times times("response", t);
  const auto& motion = *test_case.motion;
  auto arrays = Arrays::read(out, times.size(), motion.dof());
  if (!out.is_none()) refuse_overlap(times.array, arrays);
  const auto at = times.values();
  const auto to = arrays.buffers();
  const auto dof = std::size_t(motion.dof());
  {
    const py::gil_scoped_release without_gil;
    Interrupts interrupts;
    for (std::size_t first = 0; first < at.size(); first += times_together) {
      const auto count = std::min(times_together, at.size() - first);
      const auto place = [&](Span all) { return part(all, first * dof, count * dof); };
      motion.sample(at.subspan(first, count), limit, {place(to.u), place(to.v), place(to.a)});
      interrupts.check();
    }
  }
  return result(arrays.u, arrays.v, arrays.a, times.single);
}

// `of(t)` of every time, as arrays u, v and a.
py::tuple one_by_one(std::string_view who, const Case& test_case, py::handle t, const auto& of) {
  const Times times(who, t);
  const auto dof = test_case.motion->dof();
  for (const double time : times.values()) require_inside(who, time, test_case.motion->end());
  std::array<Doubles, 3> arrays;
  for (auto& array : arrays) array = Doubles({times.size(), py::ssize_t(dof)});
  std::array<double*, 3> to;
  std::ranges::transform(arrays, to.begin(), [](Doubles& array) { return array.mutable_data(); });
  {
    const py::gil_scoped_release without_gil;
    Interrupts interrupts;
    for (const double time : times.values()) {
      const model::Kinematics now = of(time);
      for (const auto& [values, k] : {std::pair{&now.u, 0}, {&now.v, 1}, {&now.a, 2}})
        to[std::size_t(k)] = std::copy(values->begin(), values->end(), to[std::size_t(k)]);
      interrupts.check();
    }
  }
  return result(arrays[0], arrays[1], arrays[2], times.single);
}

py::tuple envelope(const Case& test_case, py::handle t) {
  return one_by_one("envelope", test_case, t,
                    [&](double at) { return test_case.motion->envelope(at); });
}

py::tuple error_bound(const Case& test_case, py::handle t) {
  return one_by_one("error_bound", test_case, t,
                    [&](double at) { return test_case.motion->error_bound(at); });
}

}  // namespace

void bind_response(py::module_& core) {
  core.def("response", &response, py::arg("case"), py::arg("t"), py::arg("side"), py::arg("out"));
  core.def("envelope", &envelope, py::arg("case"), py::arg("t"));
  core.def("error_bound", &error_bound, py::arg("case"), py::arg("t"));
}

}  // namespace clackers::python
