"""bindings/matlab in Octave and bindings/R in R: the same numbers and words as the command's."""
import csv
import os
import pathlib
import subprocess
import unittest

from command import PROGRAM, CommandTest, environment

BINDINGS = pathlib.Path(__file__).resolve().parents[2] / "bindings"
OCTAVE = f"""addpath {BINDINGS}/matlab
p = clackers.problem('stop', 'eta', 0.7);
printf('%.17g %.17g %.17g %.17g\\n', p.K, p.contacts.restitution, p.start.v, p.t_end);
r = clackers.response('three-parameter', [0 1.3 20], 'N', 1);
printf('%.17g %.17g %.17g %.17g %.17g %.17g %.17g\\n', [r.t r.u r.v r.a]');
runs = {{}};
for h = 2.^-(5:8)
  e = clackers.response('stop', (0:h:20)', 'eta', 0.7);
  e.u = e.u + h^2 * sin(e.t);
  runs{{end + 1}} = e;
end
[found, text] = clackers.check(runs, 'stop', 'eta', 0.7, '--expect', 'proper:3');
printf('%s %s %.2f\\n', found.verdict, found.behaviour, found.order);
disp(text(1:9))
try, clackers.response('stpo', 1), catch, disp(lasterr()), end
"""
R = f"""source("{BINDINGS}/R/clackers.R")
r <- clackers_response("three-parameter", c(0, 1.3, 20), list(N = 1))
for (k in 1:3) cat(sprintf("%.17g", unlist(r[k, c("t", "u1", "u2", "v1", "v2", "a1", "a2")])), "\\n")
runs <- lapply(2^-(5:8), function(h) {{
  e <- clackers_response("stop", seq(0, 20, h), list(eta = 0.7))
  e$u1 <- e$u1 + h^2 * sin(e$t)
  e[c("t", "u1", "v1")]
}})
found <- clackers_check(runs, "stop", list(eta = 0.7), c("--expect", "proper:3"))
cat(nrow(found), substr(attr(found, "text")[1], 1, 9), "\\n")
tryCatch(clackers_response("stpo", 1), error = function(e) cat(conditionMessage(e), "\\n"))
"""


class OtherLanguages(CommandTest):
    def lines(self, program, *words, source):
        path = self.path("script")
        pathlib.Path(path).write_text(source)
        done = subprocess.run([program, *words, path], capture_output=True, text=True, timeout=110,
                              env={**environment(), "CLACKERS": os.path.abspath(PROGRAM)})
        # Octave 7 says so at its end when an error was caught before.
        said = done.stderr.replace("error: ignoring const execution_exception& while preparing to exit\n", "")
        self.assertEqual((done.returncode, said), (0, ""), done.stdout)
        return [line.strip() for line in done.stdout.splitlines()]

    def exact(self):
        pathlib.Path(self.path("times")).write_text("0\n1.3\n20\n")
        text = self.good("respond", "three-parameter", "--set", "N=1", "--times", self.path("times"), "--format", "csv", "--quiet")
        return [[float(row[name]) for name in ("t", "u1", "u2", "v1", "v2", "a1", "a2")] for row in csv.DictReader(text.splitlines())]

    def numbers(self, lines):
        return [[float(word) for word in line.split()] for line in lines]

    def test_octave(self):
        lines = self.lines("octave-cli", "--quiet", "--no-init-file", source=OCTAVE)
        self.assertEqual(self.numbers(lines[:1]), [[1, 0.7, -0.05, 20]])
        self.assertEqual(self.numbers(lines[1:4]), self.exact())
        self.assertRegex(lines[4], r"^disagrees reduced (2\.0\d|1\.9\d)$")
        self.assertEqual(lines[5], "Disagrees")
        self.assertIn('Did you mean "stop"?', lines[6])

    def test_r(self):
        lines = self.lines("Rscript", "--vanilla", source=R)
        self.assertEqual(self.numbers(lines[:3]), self.exact())
        self.assertEqual(lines[3], "4 Disagrees")
        self.assertIn('Did you mean "stop"?', lines[4])


if __name__ == "__main__":
    unittest.main()
