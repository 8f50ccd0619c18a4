#pragma once

#include <atomic>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clackers/record/sheet.hpp"
#include "paper/figure.hpp"

namespace clackers::paper {

/// A figure that can be made.
struct Entry {
  std::string_view name;   ///< "fig12", "figA1", "validation"
  std::string_view title;  ///< one line
  /// Fills everything but name and title; stops early when `interrupt` becomes true.
  Figure (*build)(const std::atomic<bool>* interrupt);
};

/// All figures, in the paper's order.
std::span<const Entry> entries();

/// The entries of these names, each once, in the paper's order; all when there is no name. Throws
/// InputError with did-you-mean for a name that does not exist.
std::vector<Entry> chosen(const std::vector<std::string>& names);

/// The figure of an entry with its claims, whole unless `interrupt` became true.
Figure make(const Entry& entry, const std::atomic<bool>* interrupt = nullptr);

// The builders, by the file in figures/ that holds them.
Figure free_mass();                                     ///< responses.cpp: Fig. 1
Figure mass_and_stop();                                 ///< schematic.cpp: Fig. 2
Figure response_at_stop();                              ///< responses.cpp: Fig. 3
Figure symmetric_pair();                                ///< responses.cpp: Fig. 4
Figure sample_extension();                              ///< responses.cpp: Fig. 5
Figure spectra();                                       ///< spectra.cpp: Fig. 6
Figure effect_of_N();                                   ///< parameters.cpp: Fig. 7
Figure effect_of_damping();                             ///< parameters.cpp: Fig. 8
Figure effect_of_duration();                            ///< parameters.cpp: Fig. 9
Figure three_parameters();                              ///< parameters.cpp: Fig. 10
Figure mirrored_response();                             ///< mirror.cpp: Fig. 11
Figure coincidence();                                   ///< mirror.cpp: Fig. 12
Figure positive_definite();                             ///< appendix.cpp: Fig. A.1
Figure amplitudes();                                    ///< appendix.cpp: Fig. A.2
Figure near_miss();                                     ///< near_miss.cpp: Fig. A.3
Figure validation(const std::atomic<bool>* interrupt);  ///< validation.cpp: section 2.3

/// The numbers behind a figure as csv, unreduced: panel,series,x_name,x,y_name,y; numbers read back
/// to the same double. A vertical line has an empty y.
void write_csv(const Figure& figure, std::ostream& out);

/// Every claim of the figures with its verdict, a row each; for people without section and figure.
record::Sheet claims_of(const std::vector<Figure>& figures, bool for_people = false);

/// What `clackers list figures` shows.
record::Sheet list_figures();

/// "holds", "holds where", "does not hold" or "not measurable".
const char* verdict_of(const Claim& claim);

}  // namespace clackers::paper
