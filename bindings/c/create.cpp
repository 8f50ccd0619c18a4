#include "bindings/c/guard.hpp"
#include "bindings/c/handle.hpp"
#include "bindings/c/versioned.hpp"

#ifndef CLACKERS_VERSION
#error "the build gives CLACKERS_VERSION, the version of the project"
#endif

namespace clackers::c_api {
namespace {

constexpr auto pair_case = "synchronized-pair";

struct Member {
  const char* name;
  double clackers_pair::*place;
};

constexpr Member members[] = {{"m1", &clackers_pair::m1},   {"k1", &clackers_pair::k1},
                              {"xi1", &clackers_pair::xi1}, {"A", &clackers_pair::A},
                              {"X", &clackers_pair::X},     {"r", &clackers_pair::r},
                              {"eta", &clackers_pair::eta}, {"t_end", &clackers_pair::t_end}};

void create(std::string_view name, const cases::Settings& settings, clackers_motion** motion) {
  *motion = new clackers_motion{cases::make(name, settings)};
}

void read_settings(const char* who, const clackers_setting* settings, std::size_t count,
                   cases::Settings& values) {
  if (count > 0) require_pointer(who, "settings", settings);
  for (std::size_t i = 0; i < count; ++i) {
    require_pointer(who, fmt::format("settings[{}].name", i), settings[i].name);
    values.emplace_back(settings[i].name, settings[i].value);
  }
}

void read_words(const char* who, const clackers_word* words, std::size_t count,
                cases::Settings& values) {
  if (count > 0) require_pointer(who, "words", words);
  for (std::size_t i = 0; i < count; ++i) {
    require_pointer(who, fmt::format("words[{}].name", i), words[i].name);
    require_pointer(who, fmt::format("words[{}].text", i), words[i].text);
    values.emplace_back(words[i].name, words[i].text);
  }
}

}  // namespace
}  // namespace clackers::c_api

using namespace clackers;
using namespace clackers::c_api;

const char* clackers_version(void) { return CLACKERS_VERSION; }

clackers_status clackers_pair_defaults(clackers_pair* pair) {
  return guarded([&] {
    constexpr auto who = "clackers_pair_defaults";
    require_pointer(who, "pair", pair);
    require_size(who, *pair);
    clackers_pair defaults{};
    for (const auto& parameter : cases::entry(pair_case).parameters)
      for (const auto& member : members)
        if (parameter.name == member.name) defaults.*member.place = parameter.default_value;
    write_versioned(*pair, defaults);
  });
}

clackers_status clackers_pair_create(const clackers_pair* pair, clackers_motion** motion) {
  return guarded([&] {
    constexpr auto who = "clackers_pair_create";
    require_pointer(who, "pair", pair);
    require_pointer(who, "motion", motion);
    const auto given = read_versioned(who, *pair);
    cases::Settings settings;
    for (const auto& member : members) settings.emplace_back(member.name, given.*member.place);
    create(pair_case, settings, motion);
  });
}

clackers_status clackers_case_create(const char* name, const clackers_setting* settings,
                                     size_t count, clackers_motion** motion) {
  return clackers_case_create_with_words(name, settings, count, nullptr, 0, motion);
}

clackers_status clackers_case_create_with_words(const char* name, const clackers_setting* settings,
                                                size_t count, const clackers_word* words,
                                                size_t word_count, clackers_motion** motion) {
  return guarded([&] {
    constexpr auto who = "clackers_case_create";
    require_pointer(who, "name", name);
    require_pointer(who, "motion", motion);
    cases::Settings values;
    read_settings(who, settings, count, values);
    read_words(who, words, word_count, values);
    create(name, values, motion);
  });
}

void clackers_motion_destroy(clackers_motion* motion) { delete motion; }

const char* clackers_case_name(size_t index) {
  const auto all = cases::entries();
  return index < all.size() ? all[index].name.c_str() : nullptr;
}
