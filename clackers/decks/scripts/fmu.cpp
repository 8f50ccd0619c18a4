#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "clackers/base/number.hpp"
#include "clackers/decks/rows.hpp"
#include "clackers/decks/scripts/c_text.hpp"
#include "clackers/decks/text.hpp"
#include "clackers/methods/registry.hpp"
#include "clackers/model/harmonic_load.hpp"
#include "clackers/numerics/linear_algebra.hpp"

namespace clackers::decks {
namespace {

constexpr long long most_flights = 10000;

// A row a flight, and a bound on the rates of the motion.
std::string flights_of(const Subject& subject, std::string_view format) {
  const auto& problem = subject.problem;
  const auto* motion = subject.motion.get();
  if (motion == nullptr || !motion->closed_contacts().empty() || model::one_sided_springs(problem))
    refuse_deck(format, "its flights between impacts are not all of one linear motion");
  const auto count = motion->impact_count(motion->end());
  if (count > most_flights)
    refuse_deck(format, fmt::format("the motion has {} impacts; {} at most", count, most_flights));
  Eigen::MatrixXd rows(count + 1, 2 * problem.dof() + 1);
  rows.row(0) << problem.start.t, problem.start.u.transpose(), problem.start.v.transpose();
  for (long long k = 1; k <= count; ++k) {
    const auto impact = motion->impact(k);
    rows.row(k) << impact.t, impact.after.u.transpose(), impact.after.v.transpose();
  }
  const auto& [mass, damping, stiffness] =
      std::tie(problem.system.mass, problem.system.damping, problem.system.stiffness);
  double rate = std::max(std::sqrt(numerics::solved(mass, stiffness).norm()),
                         numerics::solved(mass, damping).norm());
  if (const auto* found = problem.system.add_load.target<model::HarmonicLoad>())
    for (const auto& force : found->forces()) rate = std::max(rate, force.frequency);
  return list_of("flights", rows, c_syntax) +
         fmt::format("static const double rate = {};\n", exact_number(rate));
}

// What co-simulation gives.
struct Motion {
  std::string name, claim, text;
};

Motion motion_of(const Subject& subject, std::string_view format) {
  if (subject.method.empty())
    return {"the exact motion", "exact",
            filled(fmu_exact, {{"numbers", flights_of(subject, format)}})};
  const auto name = methods::short_name(subject.method);
  const auto integrator = methods::integrator(name);
  const auto coefficients = integrator->coefficients();
  if (coefficients.size() == 0)
    refuse_deck(format,
                fmt::format("{} is not an explicit Runge-Kutta method of fixed steps, such as "
                            "rk4, rk3 and dopri5-fixed-step",
                            name));
  return {fmt::format("{}+{}, a step a communication step", name, methods::default_treatment),
          fmt::format("proper:{}", integrator->facts().smooth_order),
          filled(fmu_method,
                 {{"numbers", list_of("method", coefficients, c_syntax)}, {"located", c_located}})};
}

// FNV-1a.
std::string token_of(std::string_view text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return fmt::format("{{{:016x}}}", hash);
}

class Description {
 public:
  Description(const model::ImpactProblem<>& problem, int version)
      : problem_(problem), version_(version) {}

  std::string text(std::string_view token, std::string_view motion) {
    const auto n = int(problem_.dof()), contacts = int(problem_.contacts.size());
    variable("time", "independent", "", "s", {});
    for (const auto& [letter, unit, start] :
         {std::tuple{'u', "m", &problem_.start.u}, {'v', "m/s", &problem_.start.v}})
      for (int i = 0; i < n; ++i)
        variable(fmt::format("{}{}", letter, i + 1), "output", "exact", unit,
                 fmt::format(" start=\"{}\"", exact_number((*start)[i])));
    for (int i = 0; i < 2 * n; ++i)
      variable(fmt::format("der({}{})", "uv"[i / n], i % n + 1), "local", "calculated",
               i < n ? "m/s" : "m/s2",
               fmt::format(" derivative=\"{}\"", i + (version_ == 2 ? 2 : 1)));
    for (int i = 0; i < contacts; ++i)
      variable(fmt::format("gap{}", i + 1), "local", "calculated", "m", {});
    const bool old = version_ == 2;
    const auto sources = old ? "<SourceFiles><File name=\"model.c\"/></SourceFiles>" : "";
    const auto structure = unknowns("Output", "Outputs", 1, 2 * n) +
                           unknowns("ContinuousStateDerivative", "Derivatives", 2 * n + 1, 2 * n) +
                           unknowns("InitialUnknown", "InitialUnknowns", 2 * n + 1, 2 * n) +
                           (old ? "" : unknowns("EventIndicator", "", 4 * n + 1, contacts));
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<fmiModelDescription fmiVersion=\"{}.0\" modelName=\"Model\" {}=\"{}\" "
        "description=\"{}\" generationTool=\"Clackers\" "
        "variableNamingConvention=\"structured\"{}>\n"
        "  <ModelExchange modelIdentifier=\"Model\">{}</ModelExchange>\n"
        "  <CoSimulation modelIdentifier=\"Model\" canHandleVariableCommunicationStepSize=\"true\">{}</CoSimulation>\n"
        "  <UnitDefinitions><Unit name=\"s\"><BaseUnit s=\"1\"/></Unit><Unit name=\"m\"><BaseUnit m=\"1\"/></Unit>"
        "<Unit name=\"m/s\"><BaseUnit m=\"1\" s=\"-1\"/></Unit><Unit name=\"m/s2\"><BaseUnit m=\"1\" s=\"-2\"/></Unit>"
        "</UnitDefinitions>\n"
        "  <DefaultExperiment startTime=\"{}\" stopTime=\"{}\"/>\n"
        "  <ModelVariables>\n{}  </ModelVariables>\n  <ModelStructure>\n{}  </ModelStructure>\n</fmiModelDescription>\n",
        version_, old ? "guid" : "instantiationToken", token, motion,
        old ? fmt::format(" numberOfEventIndicators=\"{}\"", contacts) : "", sources, sources,
        exact_number(problem_.start.t), exact_number(problem_.end), variables_, structure);
  }

 private:
  void variable(const std::string& name, std::string_view causality, std::string_view initial,
                std::string_view unit, const std::string& more) {
    const auto common = fmt::format(
        "name=\"{}\" valueReference=\"{}\" causality=\"{}\" variability=\"continuous\"{}", name,
        count_++, causality, initial.empty() ? "" : fmt::format(" initial=\"{}\"", initial));
    variables_ +=
        version_ == 2
            ? fmt::format("    <ScalarVariable {}><Real unit=\"{}\"{}/></ScalarVariable>\n", common,
                          unit, more)
            : fmt::format("    <Float64 {} unit=\"{}\"{}/>\n", common, unit, more);
  }
  // From a value reference; in FMI 2 indices, which count from 1, in a list.
  std::string unknowns(std::string_view name, std::string_view list, int first, int count) const {
    std::string text;
    for (int i = first; i < first + count; ++i)
      text += version_ == 2 ? fmt::format("<Unknown index=\"{}\"/>", i + 1)
                            : fmt::format("    <{} valueReference=\"{}\"/>\n", name, i);
    return version_ == 2 ? fmt::format("    <{0}>{1}</{0}>\n", list, text) : text;
  }

  const model::ImpactProblem<>& problem_;
  int version_, count_ = 0;
  std::string variables_;
};

constexpr auto prepare = R"sh(mode=${1:-cs}  # cs: co-simulation, me: model exchange
case $mode in cs) claim=@claim@ ;; me) claim=proper:4 ;; *) echo "run: cs or me" >&2; exit 2 ;; esac
"${CC:-cc}" -shared -fPIC -O2 -o Model.so model.c -lm
"${CC:-cc}" -O2 -o simulate simulate.c -ldl -lm
rm -rf fmu Model.fmu
mkdir -p fmu/sources "fmu/binaries/@platform@"
cp modelDescription.xml fmu && cp Model.so "fmu/binaries/@platform@" && cp @sources@ fmu/sources
(cd fmu && zip -qr ../Model.fmu .))sh";

std::vector<DeckFile> unit(const Subject& subject, int version) {
  const auto& problem = subject.problem;
  const auto format = fmt::format("fmu{}", version);
  const auto motion = motion_of(subject, format);
  const auto numbers = data(problem, c_syntax);
  const auto token = token_of(numbers + motion.text);
  const auto number = std::to_string(version);
  const Words words{{"head", head(subject, format, "//")},
                    {"fmi", number},
                    {"data", numbers},
                    {"gives", motion.name},
                    {"motion", motion.text},
                    {"located", c_located},
                    {"mechanics", c_mechanics},
                    {"token", token},
                    {"n", fmt::format("{}", problem.dof())},
                    {"contacts", fmt::format("{}", problem.contacts.size())},
                    {"t0", exact_number(problem.start.t)},
                    {"last", exact_number(problem.end)}};
  std::vector<DeckFile> files{
      {"model.c", filled(fmu_model, words)},
      {"modelDescription.xml", Description(problem, version).text(token, motion.name)},
      {"simulate.c", filled(fmu_simulate, words)},
      run_script(subject, steps(problem, shortest_period(problem) / 16.0),
                 "./simulate ./Model.so \"$mode\" \"$2\" \"$1.csv\"", ".csv", "--expect \"$claim\"",
                 filled(prepare,
                        {{"claim", motion.claim},
                         {"platform", version == 2 ? "linux64" : "$(uname -m)-linux"},
                         {"sources", version == 2 ? "model.c" : "model.c buildDescription.xml"}}))};
  if (version == 3)
    files.push_back(
        {"buildDescription.xml",
         "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n"
         "  <BuildConfiguration modelIdentifier=\"Model\">\n    <SourceFileSet language=\"C99\"><SourceFile "
         "name=\"model.c\"/></SourceFileSet>\n  </BuildConfiguration>\n</fmiBuildDescription>\n"});
  return files;
}

}  // namespace

std::vector<DeckFile> fmu2(const Subject& subject) { return unit(subject, 2); }
std::vector<DeckFile> fmu3(const Subject& subject) { return unit(subject, 3); }

}  // namespace clackers::decks
