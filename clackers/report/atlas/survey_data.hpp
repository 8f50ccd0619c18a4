#pragma once

#include <nlohmann/json_fwd.hpp>

#include "clackers/report/atlas/survey.hpp"

namespace clackers::report {

/// What atlas.js reads. Texts that many cells share stand once in "words", claims in "claims", and the
/// steps of a ladder in "ladders"; a cell is a row of the values that "fields" names, with the error in
/// u of every run, null for one that failed, and steps and force evaluations of every level. Errors
/// are rounded to four digits.
nlohmann::ordered_json survey_data(const Survey& survey, std::span<const AtlasPart> parts);

/// Performance profiles by steps and by force evaluations over the tasks of all systems: lines of the
/// methods, by their places in the survey.
nlohmann::ordered_json survey_profiles(const Survey& survey);

}  // namespace clackers::report
