#include "paper/reproduce.hpp"

#include <nlohmann/json.hpp>
#include <sstream>

#include "clackers/base/files/files.hpp"
#include "clackers/base/files/json.hpp"
#include "clackers/record/record.hpp"
#include "paper/catalogue.hpp"
#include "paper/rendering/page.hpp"

namespace clackers::paper {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr auto manifest = "paper.json";
constexpr auto schema = "clackers/paper-folder/1";

void write_numbers(const Figure& figure, const fs::path& folder) {
  std::ostringstream csv;
  write_csv(figure, csv);
  write_file(folder / (figure.name + ".csv"), csv.str());
  write_file(folder / (figure.name + ".vl.json"), json_text(specification(figure)) + "\n");
}

// What of a figure lies in the folder.
std::vector<std::string> files_of(const Figure& figure, const fs::path& folder) {
  std::vector<std::string> out;
  for (const auto* ending : {".svg", ".pdf", ".csv", ".vl.json"})
    if (fs::exists(folder / (figure.name + ending))) out.push_back(figure.name + ending);
  return out;
}

void write_manifest(const std::vector<Drawn>& drawn, const std::string& command,
                    const fs::path& folder) {
  const auto from = record::provenance(command);
  Json figures = Json::array(), files{manifest, "index.html"};
  for (const auto& item : drawn) {
    Json claims = Json::array();
    for (const auto& claim : item.figure.claims)
      claims.push_back({{"name", claim.name},
                        {"section", claim.section},
                        {"says", claim.says},
                        {"verdict", verdict_of(claim)},
                        {"condition", claim.condition},
                        {"measured", claim.measured}});
    figures.push_back({{"name", item.figure.name},
                       {"title", item.figure.title},
                       {"caption", item.figure.caption},
                       {"files", item.files},
                       {"claims", claims},
                       {"choices", item.figure.choices}});
    for (const auto& file : item.files) files.push_back(file);
  }
  const Json json{{"schema", schema},  {"version", from.version}, {"command", from.command},
                  {"date", from.date}, {"files", files},          {"figures", figures}};
  write_file(folder / manifest, json_text(json, 1) + "\n");
}

}  // namespace

Reproduction reproduce(const std::vector<Entry>& chosen, const fs::path& folder,
                       const std::string& command, const std::function<void(double)>& progress,
                       const std::atomic<bool>* interrupt) {
  Reproduction out;
  std::vector<std::string> names;
  const auto stopped = [&] { return interrupt != nullptr && interrupt->load(); };
  // Drawing takes about as long as a figure each.
  const double parts = double(chosen.size()) + 2.0;
  for (const auto& entry : chosen) {
    if (progress) progress(double(out.figures.size()) / parts);
    out.figures.push_back(make(entry, interrupt));
    names.emplace_back(entry.name);
    write_numbers(out.figures.back(), folder);
    if (stopped()) break;
  }
  if (!stopped()) out.missing = render(folder, names, interrupt);
  out.interrupted = stopped();
  if (out.interrupted) return out;

  std::vector<Drawn> drawn;
  for (const auto& figure : out.figures) {
    const auto picture = folder / (figure.name + ".svg");
    drawn.push_back({figure, fs::exists(picture) ? read_file(picture) : std::string(),
                     files_of(figure, folder)});
  }
  write_file(folder / "index.html", page(drawn, command));
  write_manifest(drawn, command, folder);
  if (progress) progress(1.0);
  return out;
}

std::vector<std::string> listed_files(const fs::path& folder) try {
  if (!fs::exists(folder / manifest)) return {};
  const auto json = parse_json(read_file(folder / manifest));
  if (!json.is_object() || json.value("schema", Json()) != schema) return {};
  const auto files = json.find("files");
  if (files == json.end() || !files->is_array()) return {};
  std::vector<std::string> out;
  for (const auto& file : *files)
    if (file.is_string()) out.push_back(file.get<std::string>());
  return out;
} catch (const Json::parse_error&) {
  return {};
}

}  // namespace clackers::paper
