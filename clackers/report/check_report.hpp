#pragma once

#include <iosfwd>
#include <string>

#include "clackers/report/write.hpp"
#include "clackers/study/check_record.hpp"

namespace clackers::report {

/// A checked history, or several as levels of one method. Table: a row a file, what limits the
/// judgement, the metrics of the finest file, the fit, and a last line with the verdict and what to
/// do next; at most style.width characters a line. Csv: a row a file, metrics as columns. Json:
/// everything, with the schema clackers/check/1. Junit: one test. Latex: a table of the files.
void write(const study::CheckRecord& record, Format format, std::ostream& out,
           const Style& style = {});

/// One self-contained page that opens without a network: verdict, files, figures (the rows over the
/// exact response, error against time, convergence of several files), metrics, case, provenance.
std::string check_html(const study::CheckRecord& record);

}  // namespace clackers::report
