#pragma once

#include "clackers/decks/deck.hpp"

// What writes each format: a row of the table in deck.cpp.
namespace clackers::decks {

std::vector<DeckFile> scipy(const Subject& subject);
std::vector<DeckFile> octave(const Subject& subject);
std::vector<DeckFile> r(const Subject& subject);
std::vector<DeckFile> cvode(const Subject& subject);
std::vector<DeckFile> fmu2(const Subject& subject);
std::vector<DeckFile> fmu3(const Subject& subject);
std::vector<DeckFile> julia(const Subject& subject);
std::vector<DeckFile> calculix(const Subject& subject);
std::vector<DeckFile> mujoco(const Subject& subject);
std::vector<DeckFile> modelica(const Subject& subject);
std::vector<DeckFile> opensees_tcl(const Subject& subject);
std::vector<DeckFile> opensees_python(const Subject& subject);
std::vector<DeckFile> abaqus(const Subject& subject);
std::vector<DeckFile> ls_dyna(const Subject& subject);
std::vector<DeckFile> code_aster(const Subject& subject);
std::vector<DeckFile> mbdyn(const Subject& subject);

}  // namespace clackers::decks
