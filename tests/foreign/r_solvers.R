# deSolve's lsodar, lsode and radau with root functions and events, and a Newmark loop by hand, as foreign
# solvers: the lines of octave_solvers.m, `method=r-lsodar tolerance=1e-6 ...`.
suppressMessages(library(deSolve))

word <- function(words, name, fallback) {
  for (pair in strsplit(words, "=")) if (pair[1] == name) return(if (length(pair) == 1) 1 else as.numeric(pair[2]))
  fallback
}

read_problem <- function(words) {
  path <- sub("problem=", "", grep("^problem=", words, value = TRUE))
  x <- scan(path, quiet = TRUE)
  n <- x[1]; contacts <- x[2]; loads <- x[3]; at <- 4
  block <- function(rows, columns) {
    found <- matrix(if (rows > 0) x[at + seq_len(rows * columns)] else numeric(0), rows, columns, byrow = TRUE)
    at <<- at + rows * columns
    found
  }
  p <- list(n = n, end = x[4], M = block(n, n), C = block(n, n), K = block(n, n))
  p$u0 <- as.vector(block(1, n)); p$v0 <- as.vector(block(1, n))
  rows <- block(contacts, n + 2); forces <- block(loads, 4)
  p$G <- rows[, seq_len(n), drop = FALSE]; p$gap <- rows[, n + 1]; p$eta <- rows[, n + 2]
  p$eta[] <- ifelse(is.na(word(words, "solver-eta", NA)), p$eta, word(words, "solver-eta", NA))
  p$K[n, n] <- p$K[n, n] * word(words, "knn*", 1)
  p$C <- p$C * word(words, "c*", 1)
  p$late <- word(words, "load-late", 0)
  p$force <- function(t) {
    f <- numeric(n)
    for (i in seq_len(loads))
      f[forces[i, 1]] <- f[forces[i, 1]] + word(words, "load*", 1) * forces[i, 2] * cos(forces[i, 3] * (t - p$late) + forces[i, 4])
    f
  }
  p
}

struck <- function(p, words, v, active) {
  if (!any(active)) return(v)
  G <- p$G[active, , drop = FALSE]
  jump <- solve(p$M, t(G) %*% solve(G %*% solve(p$M, t(G)), -(1 + p$eta[active]) * (G %*% v)))
  if (word(words, "one-mass", 0)) jump[-1] <- 0
  v + as.vector(jump)
}

adaptive <- function(p, words, method) {
  inside <- seq_len(p$n); inverse <- solve(p$M); tolerance <- word(words, "tolerance", 1e-6); impacts <- 0
  flow <- function(t, x, parms) list(c(x[p$n + inside], inverse %*% (p$force(t) - p$C %*% x[p$n + inside] - p$K %*% x[inside])))
  gaps <- function(t, x, parms) as.vector(p$G %*% x[inside]) - p$gap
  impact <- function(t, x, parms) {
    impacts <<- impacts + 1
    if (impacts > word(words, "most-impacts", Inf)) return(x)
    active <- abs(gaps(t, x)) < 1e-5 + 10 * tolerance & (p$G %*% x[p$n + inside] < 0 | word(words, "any-direction", 0) == 1)
    x[p$n + inside] <- struck(p, words, x[p$n + inside], as.vector(active))
    x
  }
  spacing <- word(words, "spacing", 0.01)
  ode(c(p$u0, p$v0), seq(0, round(p$end / spacing)) * spacing, flow, NULL, method = method, rtol = tolerance,
      atol = word(words, "atol", tolerance * 1e-2), rootfun = gaps, events = list(func = impact, root = TRUE, maxroot = 500))
}

newmark <- function(p, words) {
  steps <- word(words, "n", 1000); h <- p$end / steps
  inverse <- solve(p$M + h / 2 * p$C + h^2 / 4 * p$K)
  acceleration <- function(t, u, v) as.vector(solve(p$M, p$force(t) - p$C %*% v - p$K %*% u))
  u <- p$u0; v <- p$v0; a <- acceleration(0, u, v)
  rows <- matrix(0, steps + 1, 1 + 2 * p$n); rows[1, ] <- c(0, u, v)
  for (i in seq_len(steps)) {
    up <- u + h * v + h^2 / 4 * a; vp <- v + h / 2 * a
    a <- as.vector(inverse %*% (p$force(i * h) - p$C %*% vp - p$K %*% up))
    u <- up + h^2 / 4 * a; v <- vp + h / 2 * a
    active <- as.vector(p$G %*% u) < p$gap & as.vector(p$G %*% v) < 0
    if (any(active)) {
      v <- struck(p, words, v, active)
      if (!word(words, "stale", 0)) a <- acceleration(i * h, u, v)
    }
    rows[i + 1, ] <- c(i * h, u, v)
  }
  rows
}

for (line in readLines("stdin")) {
  words <- strsplit(trimws(line), " +")[[1]]
  p <- read_problem(words)
  method <- sub("method=r-", "", grep("^method=", words, value = TRUE))
  rows <- if (method == "newmark") newmark(p, words) else adaptive(p, words, method)
  inside <- seq_len(p$n)
  rows <- rows[, c(1, rbind(1 + inside, 1 + p$n + inside)), drop = FALSE]
  text <- apply(rows, 1, function(row) paste(sprintf("%.17g", row), collapse = ","))
  writeLines(c(paste(c("t", rbind(paste0("u", inside), paste0("v", inside))), collapse = ","), text), words[1])
}
