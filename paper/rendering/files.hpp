#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace clackers::paper {

/// Writes a whole file. Throws FileError with the system's reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);
/// The whole of a file. Throws FileError.
std::string read_file(const std::filesystem::path& path);
/// Makes a folder whose parent exists. Throws FileError.
void make_folder(const std::filesystem::path& path);

}  // namespace clackers::paper
