#pragma once

#include <bit>
#include <string>

#include "clackers/study/record/record_fields.hpp"

namespace clackers::study {

/// For tests: every member of a record bit by bit, as text, without json.
class Fingerprint {
 public:
  template <class T>
  void operator()(const char* name, const T& x) {
    text += name;
    add(x);
  }
  template <class T>
  void added(const char* name, const T& x) {
    (*this)(name, x);
  }
  std::string text;

 private:
  void add(double x) { text += " " + std::to_string(std::bit_cast<unsigned long long>(x)) + "\n"; }
  void add(const std::string& x) { text += " \"" + x + "\"\n"; }
  void add(bool x) { text += x ? " yes\n" : " no\n"; }
  void add(int x) { text += " " + std::to_string(x) + "\n"; }
  void add(long long x) { text += " " + std::to_string(x) + "\n"; }
  void add(Behaviour x) { add(std::string(to_string(x))); }
  void add(Verdict x) { add(std::string(to_string(x))); }
  template <class T>
  void add(const std::optional<T>& x) {
    text += x ? " some" : " none";
    if (x) add(*x);
  }
  template <class T>
  void add(const std::vector<T>& x) {
    text += " " + std::to_string(x.size()) + " of\n";
    for (const auto& item : x) add(item);
  }
  template <class T>
  void add(const T& x) {
    fields(*this, x);
  }
};

inline std::string fingerprint(const Record& record) {
  Fingerprint all;
  fields(all, record);
  return all.text;
}

}  // namespace clackers::study
