#include "clackers/campaign/engines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "clackers/base/check.hpp"
#include "clackers/base/files/files.hpp"
#include "clackers/base/files/toml_reader.hpp"
#include "clackers/base/text.hpp"
#include "clackers/campaign/atlas.hpp"
#include "clackers/study/check.hpp"

namespace clackers::campaign {
namespace {

namespace fs = std::filesystem;

// The ladder of programs that take seconds: 15 runs with steps, 7 with tolerances.
constexpr std::string_view ladder =
    "[ladder]\nlevels = 5\nsamples_per_level = 3\ncoarsest = 0.016\ntolerances = \"1e-4:1e-10\"\n";

class EngineReader : public TomlReader {
 public:
  using TomlReader::TomlReader;

  Engine read(const toml::table& root) const {
    require_known(root,
                  {"name", "integrates", "licence", "debian", "npm", "version", "build", "command",
                   "sources", "traps", "settings", "facts", "steps"},
                  "");
    Engine engine;
    engine.name = word(need(root, "name", "the engine's name"), "name");
    engine.integrates = word(need(root, "integrates", "its method"), "integrates");
    engine.licence = word(need(root, "licence", "its licence"), "licence");
    engine.version = word(need(root, "version", "a command that prints the version"), "version");
    engine.command = word(need(root, "command", "a command as for verify --exec"), "command");
    if (const auto* npm = root.get("npm")) engine.npm = word(*npm, "npm");
    if (const auto* build = root.get("build")) engine.build = word(*build, "build");
    engine.debian = words(root, "debian");
    engine.sources = words(root, "sources");
    engine.traps = words(root, "traps");
    need(root, "settings", "[[settings]] above each setting");
    for (const auto& node : *tables(root, "settings"))
      engine.settings.push_back(setting(*node.as_table()));
    if (const auto* steps = root.get("steps"))
      for (const auto& item : list(*steps, "steps")) engine.steps.push_back(number(item, "a step"));
    if (root.contains("facts"))
      for (const auto& node : *tables(root, "facts"))
        engine.facts.push_back(fact(*node.as_table()));
    return engine;
  }

 private:
  std::vector<std::string> words(const toml::table& root, const char* key) const {
    std::vector<std::string> found;
    if (const auto* node = root.get(key))
      for (const auto& item : list(*node, key)) found.push_back(word(item, key));
    return found;
  }
  EngineFact fact(const toml::table& values) const {
    require_known(values, {"text", "setting", "case", "quantity", "is", "from", "to", "source"},
                  " of a fact");
    return {word(need(values, "text", "a sentence"), "text"),
            word(need(values, "setting", "the setting that shows it"), "setting"),
            word(need(values, "case", "the case"), "case")};
  }
  EngineSetting setting(const toml::table& values) const {
    require_known(values, {"name", "words", "why", "expect"}, " of a setting");
    EngineSetting found;
    found.name = word(need(values, "name", "the setting's name"), "name");
    found.why = word(need(values, "why", "what is set, and why"), "why");
    if (const auto* text = values.get("words")) found.words = word(*text, "words");
    if (const auto* claim = values.get("expect")) {
      found.expect = word(*claim, "expect");
      at(*claim, [&] { return study::claim_from(found.expect); });
    }
    return found;
  }
};

}  // namespace

std::string Engine::filled(std::string_view text, const std::string& program) const {
  std::string out(text);
  const std::pair<std::string_view, const std::string&> words[] = {{"{folder}", folder},
                                                                   {"{program}", program}};
  for (const auto& [mark, value] : words)
    for (auto at = out.find(mark); at != std::string::npos; at = out.find(mark, at + value.size()))
      out.replace(at, mark.size(), value);
  return out;
}

std::string Engine::installation() const {
  if (npm.empty()) return fmt::format("apt-get install {}", fmt::join(debian, " "));
  return fmt::format("npm ci --prefix {} (package {})",
                     shell_quoted(fs::path(folder).parent_path().string()), npm);
}

std::vector<Engine> engines_in(const std::string& path) {
  std::vector<Engine> engines;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    const auto file = (entry.path() / "engine.toml").string();
    if (!fs::exists(file)) continue;
    auto engine = EngineReader(file).read(toml_from(read_file(file), file));
    engine.id = entry.path().filename().string();
    engine.folder = fs::absolute(entry.path()).string();
    engines.push_back(std::move(engine));
  }
  if (engines.empty())
    throw FileError(
        fmt::format(
            "{}: no folder with an engine.toml{}. Give the folder of the engines with --engines FOLDER.",
            path, error ? ": " + error.message() : ""),
        "cannot-read");
  std::ranges::sort(engines, {}, &Engine::id);
  return engines;
}

const Engine& engine_of(std::span<const Engine> engines, const std::string& id) {
  const auto found = std::ranges::find(engines, id, &Engine::id);
  if (found != engines.end()) return *found;
  std::vector<std::string> names;
  for (const auto& engine : engines) names.push_back(engine.id);
  refuse_name("engine", id, names, "clackers engines list");
}

std::string engines_specification(std::span<const EngineRun> runs, std::string_view cases) {
  std::vector<MethodEntry> entries;
  for (const auto& [engine, setting, version, program] : runs) {
    auto command = engine->filled(engine->command, program);
    if (!setting->words.empty()) command += " " + setting->words;
    entries.push_back({MethodEntry::Kind::command,
                       std::move(command),
                       fmt::format("{}/{} {}", engine->id, setting->name, version),
                       setting->expect,
                       {{"engine", engine->name},
                        {"id", engine->id},
                        {"setting", setting->name},
                        {"version", version},
                        {"licence", engine->licence},
                        {"integrates", engine->integrates},
                        {"why", setting->why}},
                       engine->steps});
    for (const auto& fact : engine->facts)
      if (fact.setting == setting->name)
        entries.back().labels["fact " + fact.case_word] = fact.text;
  }
  return with_methods(
      fmt::format(
          "metrics = [\"restitution-median\", \"restitution-smallest\", \"force-share-first\"]\n{}{}",
          ladder, cases),
      entries);
}

std::string_view engine_cases() {
  return "[[cases]]\ncase = \"three-parameter\"\n"
         "[[cases]]\ncase = \"synchronized-pair\"\nset = { eta = 0.7 }\n"
         "[[cases]]\ncase = \"stop\"\n"
         "[[cases]]\ncase = \"buildings\"\n";
}

record::Sheet engine_list(std::span<const Engine> engines, std::span<const std::string> versions) {
  record::Sheet sheet{"clackers/engines/1",
                      "",
                      {{"engine", "", "name for run and show"},
                       {"version", "", "as installed here; empty: not installed"},
                       {"settings", "", "ways to run it"},
                       {"licence", "", ""}},
                      {}};
  for (std::size_t i = 0; i < engines.size(); ++i) {
    std::vector<std::string> names;
    for (const auto& setting : engines[i].settings) names.push_back(setting.name);
    sheet.rows.push_back({engines[i].id, versions[i].empty() ? record::Cell() : versions[i],
                          fmt::format("{}", fmt::join(names, ", ")), engines[i].licence});
  }
  return sheet;
}

record::Sheet engine_sheet(const Engine& engine, const std::string& version) {
  record::Sheet sheet{"clackers/engine/1", engine.name, {{"what", "", ""}, {"value", "", ""}}, {}};
  const auto add = [&](std::string what, std::string value) {
    sheet.rows.push_back({std::move(what), std::move(value)});
  };
  add("integrates", engine.integrates);
  add("version", version.empty() ? "not installed; " + engine.installation() : version);
  add("licence", engine.licence);
  add("command", engine.command);
  for (const auto& setting : engine.settings)
    add("setting " + setting.name,
        setting.why + (setting.words.empty() ? "" : " (" + setting.words + ")"));
  for (const auto& fact : engine.facts) add("fact", fact.text);
  for (const auto& trap : engine.traps) add("trap", trap);
  for (const auto& source : engine.sources) add("source", source);
  return sheet;
}

}  // namespace clackers::campaign
