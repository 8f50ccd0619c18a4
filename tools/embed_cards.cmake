# Writes a C++ source that holds the card of every method: the /// comment right above
# `struct Name {` of its header, without the slashes. The name of a card is the header's stem with
# hyphens. cmake -DOUTPUT=<cpp> -DHEADERS=<a,b,...> -P embed_cards.cmake

string(REPLACE "," ";" headers "${HEADERS}")
set(rows "")
foreach(header IN LISTS headers)
  file(READ ${header} text)
  get_filename_component(stem ${header} NAME_WE)
  string(REPLACE "_" "-" name ${stem})
  if(NOT text MATCHES "static constexpr std::string_view name")
    continue()  # no method: a helper of one
  endif()
  if(NOT text MATCHES "\n((///[^\n]*\n)+)struct [A-Za-z0-9]+ {\n  static constexpr std::string_view name")
    message(FATAL_ERROR "${header}: no card (a /// comment) above the struct with a name")
  endif()
  set(card "\n${CMAKE_MATCH_1}")
  string(REGEX REPLACE "\n/// ?" "\n" card "${card}")
  string(REGEX REPLACE "^\n" "" card "${card}")
  string(APPEND rows "    {\"${name}\", R\"card(${card})card\"},\n")
endforeach()

file(WRITE ${OUTPUT} "// Written by tools/embed_cards.cmake at build time.
#include \"clackers/methods/registry.hpp\"

#include <string_view>

namespace clackers::methods {
namespace {

struct Card {
  std::string_view name, text;
};

constexpr Card cards[] = {
${rows}};

}  // namespace

std::string_view card_in_header(std::string_view name) {
  for (const auto& row : cards)
    if (row.name == name) return row.text;
  return {};
}

}  // namespace clackers::methods
")
