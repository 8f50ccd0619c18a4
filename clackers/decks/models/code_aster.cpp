#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "clackers/base/number.hpp"
#include "clackers/decks/models/network.hpp"
#include "clackers/decks/rows.hpp"

namespace clackers::decks {
namespace {

constexpr double apart = 1000.0;  // nodes in a line

/// Places in a line, each of its own, the ground last: a contact (DIS_CHOC) is closed by what shortens its element, so `upper`
/// stands behind `lower`.
std::vector<int> places_of(const Network& network) {
  const auto n = int(network.masses.size());
  std::vector<int> places(std::size_t(n) + 1, 0);
  const auto place = [&](int mass) -> int& {
    return places[std::size_t(mass == ground ? n : mass)];
  };
  for (int round = 0; round <= n; ++round)
    for (const auto& stop : network.one_sided())
      place(stop.upper) = std::max(place(stop.upper), place(stop.lower) + 1);
  for (const auto& stop : network.one_sided())
    if (place(stop.upper) <= place(stop.lower))
      refuse_deck("code-aster",
                  "its contacts push masses apart in a line, which these do not form");
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return places[i]; });
  for (std::size_t rank = 0; rank < order.size(); ++rank) places[order[rank]] = int(rank);
  return places;
}

}  // namespace

std::vector<DeckFile> code_aster(const Subject& subject) {
  const auto& problem = subject.problem;
  const auto network = network_of(subject, "code-aster", {.loads = true});
  const auto levels = compliant_steps(network, problem);
  const auto places = places_of(network);
  const auto n = int(network.masses.size());
  const auto node = [&](int mass) { return fmt::format("N{}", mass == ground ? n + 1 : mass + 1); };
  // The mesh, the discrete elements, the materials and laws of contacts, the fields of the start, the loads.
  std::string mesh = "TITRE\nClackers\nFINSF\nCOOR_3D\n", points = "POI1\n", segments = "SEG2\n",
              groups, elements, materials, given, laws, fields[2], loads;
  for (int i = 0; i <= n; ++i)
    mesh += fmt::format("N{} {} 0.0 0.0\n", i + 1, exact_number(apart * places[std::size_t(i)]));
  for (int i = 0; i < n; ++i) {
    points += fmt::format("M{0} N{0}\n", i + 1);
    groups += fmt::format("GROUP_MA\nM{0} M{0}\nFINSF\n", i + 1);
    elements += fmt::format("    _F(GROUP_MA=\"M{}\", CARA=\"M_T_D_N\", VALE={}),\n", i + 1,
                            exact_number(network.masses[std::size_t(i)]));
    for (const auto& [field, values] :
         {std::pair{&fields[0], &problem.start.u}, {&fields[1], &problem.start.v}})
      *field += fmt::format("    _F(NOEUD=\"N{}\", NOM_CMP=\"DX\", VALE={}),\n", i + 1,
                            exact_number((*values)[i]));
  }
  const auto segment = [&](const std::string& name, int first, int second) {
    segments += fmt::format("{} {} {}\n", name, node(first), node(second));
    groups += fmt::format("GROUP_MA\n{0} {0}\nFINSF\n", name);
  };
  for (int number = 0; const auto& link : network.links) {
    const auto name = fmt::format("L{}", ++number);
    segment(name, link.mass, link.other);
    for (const auto& [kind, value] : {std::pair{'K', link.stiffness}, {'A', link.damping}})
      elements += fmt::format("    _F(GROUP_MA=\"{}\", CARA=\"{}_T_D_L\", VALE=({}, 0.0, 0.0)),\n",
                              name, kind, exact_number(value));
  }
  for (int number = 0; const auto& stop : network.one_sided()) {
    const auto name = fmt::format("C{}", ++number);
    const auto at = [&](int mass) { return places[std::size_t(mass == ground ? n : mass)]; };
    segment(name, stop.lower, stop.upper);
    elements +=
        fmt::format("    _F(GROUP_MA=\"{}\", CARA=\"K_T_D_L\", VALE=(0.0, 0.0, 0.0)),\n", name);
    materials += fmt::format("{} = DEFI_MATERIAU(DIS_CONTACT=_F(RIGI_NOR={}, DIST_1={}))\n", name,
                             exact_number(stop.stiffness),
                             exact_number(apart * (at(stop.upper) - at(stop.lower)) + stop.gap));
    given += fmt::format("    _F(GROUP_MA=\"{0}\", MATER={0}),\n", name);
    laws += fmt::format("    _F(GROUP_MA=\"{}\", RELATION=\"DIS_CHOC\"),\n", name);
  }
  for (int number = 0; const auto& load : network.loads)
    loads += fmt::format(
        "load{0} = AFFE_CHAR_MECA(MODELE=model, FORCE_NODALE=_F(NOEUD=\"N{1}\", FX={2}))\n"
        "time{0} = FORMULE(NOM_PARA=\"INST\", VALE=\"cos({3} * INST + {4})\")\n"
        "excitations.append(_F(CHARGE=load{0}, FONC_MULT=time{0}))\n",
        ++number, load.dof + 1, exact_number(load.amplitude), exact_number(load.frequency),
        exact_number(load.phase));
  mesh += fmt::format("FINSF\n{}FINSF\n{}FINSF\n{}FIN\n", points, segments, groups);
  const auto text = filled(
      R"py(@head@# @note@
from math import cos

DEBUT(PAR_LOT="NON")
mesh = LIRE_MAILLAGE(FORMAT="ASTER", UNITE=20)
model = AFFE_MODELE(MAILLAGE=mesh, AFFE=_F(TOUT="OUI", PHENOMENE="MECANIQUE", MODELISATION="DIS_T"))
elements = AFFE_CARA_ELEM(MODELE=model, DISCRET=(
@elements@))
steel = DEFI_MATERIAU(ELAS=_F(E=1.0, NU=0.0))
@materials@material = AFFE_MATERIAU(MAILLAGE=mesh, AFFE=(
    _F(TOUT="OUI", MATER=steel),
@given@))
held = AFFE_CHAR_MECA(MODELE=model, DDL_IMPO=(_F(TOUT="OUI", DY=0.0, DZ=0.0), _F(NOEUD="N@ground@", DX=0.0)))
excitations = [_F(CHARGE=held)]
@loads@u = CREA_CHAMP(OPERATION="AFFE", TYPE_CHAM="NOEU_DEPL_R", MAILLAGE=mesh, AFFE=(
    _F(TOUT="OUI", NOM_CMP=("DX", "DY", "DZ"), VALE=(0.0, 0.0, 0.0)),
@u@))
v = CREA_CHAMP(OPERATION="AFFE", TYPE_CHAM="NOEU_DEPL_R", MAILLAGE=mesh, AFFE=(
    _F(TOUT="OUI", NOM_CMP=("DX", "DY", "DZ"), VALE=(0.0, 0.0, 0.0)),
@v@))
steps = round((@last@ - @t0@) / @h@)
times = DEFI_LIST_REEL(DEBUT=@t0@, INTERVALLE=_F(JUSQU_A=@last@, NOMBRE=steps))
run = DYNA_NON_LINE(
    MODELE=model, CHAM_MATER=material, CARA_ELEM=elements, EXCIT=excitations, ETAT_INIT=_F(DEPL=u, VITE=v),
    COMPORTEMENT=(
    _F(TOUT="OUI", RELATION="ELAS"),
@laws@),
    SCHEMA_TEMPS=_F(SCHEMA="NEWMARK", FORMULATION="DEPLACEMENT", BETA=0.25, GAMMA=0.5),
    INCREMENT=_F(LIST_INST=times), NEWTON=_F(REAC_ITER=1), CONVERGENCE=_F(RESI_GLOB_RELA=1e-9, ITER_GLOB_MAXI=50))
columns = {}
for name, field in (("u", "DEPL"), ("v", "VITE")):
    for i in range(1, @ground@):
        curve = RECU_FONCTION(RESULTAT=run, NOM_CHAM=field, NOM_CMP="DX", NOEUD=f"N{i}", TOUT_ORDRE="OUI")
        columns["t"], columns[f"{name}{i}"] = curve.Valeurs()
with open("fort.38", "w") as file:
    file.write(",".join(columns) + "\n")
    for row in zip(*columns.values()):
        file.write(",".join(map(repr, row)) + "\n")
FIN()
)py",
      {{"head", head(subject, "code-aster", "#")},
       {"note", stiffness_note(network)},
       {"elements", elements},
       {"materials", materials},
       {"given", given},
       {"loads", loads},
       {"u", fields[0]},
       {"v", fields[1]},
       {"laws", laws},
       {"ground", std::to_string(n + 1)},
       {"t0", exact_number(problem.start.t)},
       {"last", exact_number(problem.end)},
       {"h", exact_number(levels[0].value)}});
  const auto solve = fmt::format(
      "sed \"s| / {}) *$| / $2)|\" model.comm > \"$1.comm\"\n"
      "  printf 'P actions make_etude\\nP mode interactif\\nF comm %s D 1\\nF mail model.mail D 20\\n"
      "F libr %s R 38\\n' \"$1.comm\" \"$1.csv\" > \"$1.export\"\n"
      "  \"${{AS_RUN:-run_aster}}\" \"$1.export\" > \"$1.log\"",
      exact_number(levels[0].value));
  return {{"model.comm", text},
          {"model.mail", mesh},
          run_script(subject, levels, solve, ".csv", compliant_claim(network))};
}

}  // namespace clackers::decks
