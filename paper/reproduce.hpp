#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "paper/catalogue.hpp"
#include "paper/rendering/render.hpp"

namespace clackers::paper {

struct Reproduction {
  std::vector<Figure> figures;
  std::vector<Missing> missing;  ///< empty when every picture was drawn
  bool interrupted = false;      ///< the folder is not complete
};

/// Computes the figures and fills `folder`, which exists and is empty: of each figure NAME.csv,
/// NAME.vl.json, NAME.svg and NAME.pdf; index.html; paper.json, which lists all files. Throws
/// FileError. Stops within 0.2 s when `interrupt` becomes true.
Reproduction reproduce(const std::vector<Entry>& chosen, const std::filesystem::path& folder,
                       const std::string& command,
                       const std::function<void(double share)>& progress = {},
                       const std::atomic<bool>* interrupt = nullptr);

/// The files that paper.json of a folder lists, itself among them; empty where there is none of
/// `clackers paper`.
std::vector<std::string> listed_files(const std::filesystem::path& folder);

}  // namespace clackers::paper
