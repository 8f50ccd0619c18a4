#pragma once

#include <cstddef>
#include <string>

namespace clackers::report {

/// The words around a drawn figure, html. `name` is that of its specification, `rows` that of the
/// data which its button CSV saves.
struct FigureText {
  std::string name, rows, title, caption, reading;
  std::string choices;  ///< buttons of its own, before the tools
};

/// A figure with title, caption, place for the drawing, tools, and how to read it.
std::string figure(int number, const FigureText& text);

/// A button of a legend that shows or hides a series. `key` is html, the others text.
std::string toggle(const std::string& series, const std::string& key, const std::string& text);

/// The legend of the figure "response"; `rows`: rows of a checked history are drawn too.
std::string response_legend(std::size_t masses, bool collisions, bool rows = false);

/// Buttons that choose the mass of the figure "history"; nothing for one mass.
std::string mass_choice(std::size_t masses);

}  // namespace clackers::report
