#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "clackers/record/record.hpp"

namespace clackers::cli {

/// Throws FileError: the file, the system's reason for `error_number` and what to do about it.
[[noreturn]] void fail_to_write(const std::string& file, int error_number);

/// The file that `path` means: links are followed, also one to a file that does not exist yet.
std::filesystem::path followed(std::filesystem::path path);

/// A path beside `target` that no other run chooses: ".clackers-0123456789abcdef.tmp".
std::string temporary_beside(const std::filesystem::path& target);

/// Makes the names in a folder survive a power cut, where the file system can.
void sync_folder(const std::filesystem::path& folder);

/// A file and the option that named it.
struct NamedFile {
  std::string option;  ///< "--out"
  std::string path;    ///< "-" is standard input
};

/// Throws InputError when an output is also an input or another output, by whatever name or link.
/// A baseline may be --out, which updates it.
void require_distinct_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

/// The times [s] of a text file with one a line, or of the column t of a history or .npy file; "-"
/// reads standard input. Throws InputError, with the number of the line, for what is no number or
/// lies outside [0, end], and when there is none at all; FileError when the file cannot be read;
/// Interrupted.
std::vector<double> read_times(const std::string& path, double end);

/// The record of an earlier `verify --format json`; "-" reads standard input. Throws FileError when
/// the file cannot be read, InputError with its name and the place when it is no such record,
/// after the word for `who` asks; Interrupted.
record::Record read_record(const std::string& path, const std::string& who);

}  // namespace clackers::cli
