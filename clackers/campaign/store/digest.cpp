#include "clackers/campaign/store/digest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "clackers/base/error.hpp"
#include "clackers/campaign/store/schema.hpp"

namespace clackers::campaign {
namespace {

// What stands before a cell, so that no other kind of cell has the same words.
enum Mark : std::uint64_t { nothing = 1, number, whole, text };

[[noreturn]] void damaged(const Sqlite& database, const std::string& what) {
  throw InputError(
      fmt::format("{}: the database is damaged, or was changed by another program: {} differ from "
                  "what was written. Use a backup, or run the campaign again into another file.",
                  database.path(), what),
      "not-a-campaign");
}

// A bijection of the word for any bits, and of the bits for any word.
std::uint64_t mixed(std::uint64_t bits, std::uint64_t word) {
  bits = (std::rotl(bits, 23) ^ word) * 0x9e3779b97f4a7c15u;
  return bits ^ (bits >> 32);
}

std::string seal_of(const Sqlite& database) {
  auto bits = digest(digest(0, 0LL), 0LL);
  auto rows =
      database.prepare("SELECT key, value FROM campaign WHERE key != 'digest' ORDER BY key");
  while (rows.step()) bits = digest(digest(bits, rows.cell(0)), rows.cell(1));
  return fmt::format("{:016x}", bits);
}

}  // namespace

std::uint64_t digest(std::uint64_t before, const record::Cell& cell) {
  if (const auto* real = std::get_if<double>(&cell); real != nullptr && !std::isnan(*real))
    return mixed(mixed(before, number), std::bit_cast<std::uint64_t>(*real + 0.0));
  if (const auto* integer = std::get_if<long long>(&cell)) {
    // A column of reals gives a whole number back as a real one.
    constexpr long long exact = 1LL << 53;
    if (*integer > -exact && *integer < exact) return digest(before, double(*integer));
    return mixed(mixed(before, whole), static_cast<std::uint64_t>(*integer));
  }
  const auto* words = std::get_if<std::string>(&cell);
  if (words == nullptr) return mixed(before, nothing);
  auto bits = mixed(before, text + 8 * words->size());
  for (std::size_t at = 0; at < words->size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, words->data() + at, std::min<std::size_t>(8, words->size() - at));
    bits = mixed(bits, word);
  }
  return bits;
}

void require_whole(const Sqlite& database, const std::string& table) {
  auto rows = database.prepare(
      fmt::format("SELECT * FROM {} ORDER BY task{}", table, table == "subjects" ? "" : ", run"));
  auto digests =
      database.prepare(fmt::format("SELECT task, runs, of_{} FROM digests ORDER BY task", table));
  bool has_row = rows.step();  // now both see the same rows, whoever writes meanwhile
  while (digests.step()) {
    const auto task = digests.whole(0);
    auto bits = digest(digest(0, task), digests.whole(1));
    for (; has_row && rows.whole(0) == task; has_row = rows.step())
      for (int i = 1; i < rows.columns(); ++i) bits = digest(bits, rows.cell(i));
    if (bits != static_cast<std::uint64_t>(digests.whole(2)))
      damaged(database, fmt::format("the rows of task {} in {}", task, table));
  }
  if (has_row) damaged(database, fmt::format("the rows of task {} in {}", rows.whole(0), table));
}

void seal(const Sqlite& database) {
  database.prepare("INSERT OR REPLACE INTO campaign VALUES ('digest', ?)").run({seal_of(database)});
}

void require_sealed(const Sqlite& database) {
  if (value_of(database, "digest") != seal_of(database))
    damaged(database, "the specification or its origin");
}

}  // namespace clackers::campaign
