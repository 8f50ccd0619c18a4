# deSolve: lsodar or lsodes with roots and an event function.
#     desolve.R PROBLEM.txt TOLERANCE HISTORY.csv
library(deSolve)
words <- commandArgs(trailingOnly = TRUE)
lines <- strsplit(readLines(words[1]), "=")
problem <- lapply(lines, function(x) as.numeric(strsplit(x[2], " ")[[1]]))
names(problem) <- sapply(lines, `[`, 1)
n <- problem$dof
rows <- function(name, count) do.call(rbind, problem[paste0(name, seq_len(count))])
M <- rows("M", n); C <- rows("C", n); K <- rows("K", n)
B <- rows("direction", problem$contacts)
gap <- unlist(problem[paste0("gap", seq_len(problem$contacts))])
eta <- unlist(problem[paste0("restitution", seq_len(problem$contacts))])
inverse <- solve(M)
motion <- function(t, y, p) list(c(y[n + 1:n], -inverse %*% (K %*% y[1:n] + C %*% y[n + 1:n])))
gaps <- function(t, y, p) as.vector(B %*% y[1:n]) - gap
impact <- function(t, y, p) {
  for (k in which(abs(gaps(t, y, p)) < 1e-6 & B %*% y[n + 1:n] < 0)) {
    push <- inverse %*% B[k, ]
    y[n + 1:n] <- y[n + 1:n] - (1 + eta[k]) * sum(B[k, ] * y[n + 1:n]) / sum(B[k, ] * push) * push
  }
  y
}
times <- problem$t + (problem$end - problem$t) * (0:2000) / 2000
before <- proc.time()[1]
out <- ode(c(problem$u, problem$v), times, motion, NULL, method = "lsodar", rtol = as.numeric(words[2]), atol = as.numeric(words[2]),
           rootfun = gaps, events = list(func = impact, root = TRUE), maxsteps = 1e5)
colnames(out) <- c("t", paste0("u", 1:n), paste0("v", 1:n))
file <- file(words[3], "w")
writeLines(paste(colnames(out), collapse = ","), file)
writeLines(apply(out, 1, function(row) paste(sprintf("%.17g", row), collapse = ",")), file)
writeLines(sprintf("# seconds %g", proc.time()[1] - before), file)
close(file)
