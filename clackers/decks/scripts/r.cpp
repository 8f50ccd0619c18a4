#include "clackers/decks/rows.hpp"
#include "clackers/decks/scripts/data.hpp"
#include "clackers/decks/text.hpp"

namespace clackers::decks {
namespace {

constexpr Syntax r_syntax = {
    .comment = "#",
    .table = "@name@ <- matrix(as.numeric(c(@values@)), ncol = @columns@, byrow = TRUE)\n",
    .vector = "@name@ <- c(@values@)\n",
    .number = "@name@ <- @value@\n",
    .line = "",
};

constexpr auto r_model = R"r(@head@# Usage: Rscript model.R TOLERANCE HISTORY.csv
library(deSolve)

@data@
words <- commandArgs(trailingOnly = TRUE)
tolerance <- as.numeric(words[1])
n <- length(u0)
u <- 1:n
v <- n + u
B <- contacts[, u, drop = FALSE]
inverse <- solve(M)

motion <- function(t, y, p) {
  force <- as.vector(-C %*% y[v] - K %*% y[u])
  for (k in seq_len(nrow(loads)))
    force[loads[k, 1]] <- force[loads[k, 1]] + loads[k, 2] * cos(loads[k, 3] * t + loads[k, 4])
  for (k in seq_len(nrow(springs)))
    force <- force - springs[k, n + 2] * min(sum(springs[k, u] * y[u]) - springs[k, n + 1], 0) * springs[k, u]
  list(c(y[v], inverse %*% force))
}
gaps <- function(t, y, p) as.vector(B %*% y[u]) - contacts[, n + 1]

# Newton's law, one contact after the other, until none of those that touch is closing. lsodar stops at both
# directions of a crossing, hence the sign of the rate; it also calls this once at the start.
impacts <- function(t, y, p) {
  for (trial in 1:1000) {
    k <- which(gaps(t, y, p) < 1e-6 & as.vector(B %*% y[v]) < 0)
    if (length(k) == 0) return(y)
    jump <- as.vector(inverse %*% B[k[1], ])
    y[v] <- y[v] - (1 + contacts[k[1], n + 2]) * sum(B[k[1], ] * y[v]) / sum(B[k[1], ] * jump) * jump
  }
  stop("Several contacts stay closed: this script has no rule for that.")
}

# hmax = 0: without it the step is at most that between rows, whatever the tolerance.
times <- t0 + (last - t0) * (0:4000) / 4000
start <- c(u0, v0)
if (nrow(contacts) > 0) {
  table <- ode(start, times, motion, NULL, method = "lsodar", rtol = tolerance, atol = tolerance, maxsteps = 1e5, hmax = 0,
               rootfun = gaps, events = list(func = impacts, root = TRUE))
} else {
  table <- ode(start, times, motion, NULL, method = "lsodar", rtol = tolerance, atol = tolerance, maxsteps = 1e5, hmax = 0)
}
if (any(table[, 1 + u, drop = FALSE] %*% t(B) < rep(contacts[, n + 1], each = nrow(table)) - 0.01 * max(abs(table[, 1 + u]))))
  stop("A contact stays closed, or closes and opens within a step.")
colnames(table) <- c("t", paste0("u", u), paste0("v", u))
file <- file(words[2], "w")
writeLines(paste(colnames(table), collapse = ","), file)
writeLines(apply(table, 1, function(row) paste(sprintf("%.17g", row), collapse = ",")), file)
close(file)
)r";

}  // namespace

std::vector<DeckFile> r(const Subject& subject) {
  return {{"model.R", filled(r_model, {{"head", head(subject, "r", "#")},
                                       {"data", data(subject.problem, r_syntax)}})},
          run_script(subject, tolerances(), "Rscript model.R \"$2\" \"$1.csv\"", ".csv",
                     "--expect proper:1")};
}

}  // namespace clackers::decks
