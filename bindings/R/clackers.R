# Exact motions and verdicts in R: functions that call the command clackers and read what it prints. source() this
# file; the variable CLACKERS of the environment names the command where it is not on PATH.

clackers_command <- function(words) {
  program <- Sys.getenv("CLACKERS", "clackers")
  notes <- tempfile()
  on.exit(unlink(notes))
  lines <- suppressWarnings(system2(program, shQuote(words), stdout = TRUE, stderr = notes))
  status <- attr(lines, "status")
  # 1 is a verdict against a claim, 3 is undecided.
  if (!is.null(status) && !(status %in% c(1, 3))) stop(paste(readLines(notes), collapse = "\n"), call. = FALSE)
  lines
}

clackers_settings <- function(settings)
  unlist(lapply(names(settings), function(name) c("--set", sprintf("%s=%.17g", name, settings[[name]]))))

# The exact motion of a case at the times t [s]: a data frame with t, u1 [m], v1 [m/s], a1 [m/s^2], ...; after the
# impact where a time is the double nearest to one. clackers_response("stop", seq(0, 20, 0.01), list(eta = 0.7))
clackers_response <- function(case, t, settings = list()) {
  times <- tempfile()
  on.exit(unlink(times))
  writeLines(sprintf("%.17g", t), times)
  words <- c("respond", case, clackers_settings(settings), "--times", times, "--format", "csv", "--quiet")
  rows <- read.csv(text = clackers_command(words), colClasses = c(side = "character"))
  rows[rows$side != "-", names(rows) != "side"]
}

# Judges a ladder of runs of one solver: data frames with t, u1, v1, u2, v2, ..., each of another step, at least four
# for an order. A data frame with a row a run; the attribute "text" is the table that people read.
clackers_check <- function(runs, case, settings = list(), options = character()) {
  folder <- tempfile()
  dir.create(folder)
  on.exit(unlink(folder, recursive = TRUE))
  files <- file.path(folder, sprintf("run%02d.csv", seq_along(runs)))
  for (k in seq_along(runs)) {
    text <- lapply(runs[[k]], function(column) sprintf("%.17g", column))
    write.csv(as.data.frame(text), files[k], row.names = FALSE, quote = FALSE)
  }
  words <- c("check", files, "--case", case, clackers_settings(settings), options, "--quiet")
  found <- read.csv(text = clackers_command(c(words, "--format", "csv")))
  attr(found, "text") <- clackers_command(words)
  found
}
