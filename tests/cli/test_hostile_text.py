"""Names and headers made by somebody else must not reach a terminal as they are (CWE-150)."""
import os
import re
import subprocess
import unittest

import databases
from command import PROGRAM, CommandTest, environment

# What rewrites a terminal: C0 but the line feed, DEL, C1, separators and directions of text; and
# bytes that are no UTF-8.
FORBIDDEN = re.compile("[\x00-\x09\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ufeff\udc80-\udcff]")
HOSTILE = ("\x1b[31mred", "\x1b]0;title\x07", "back\b\b\b", "line\rover", "tab\tulator", "del\x7f", "c1\u009b31m",
           "override\u202etxt.csv", "isolate\u2066x\u2069", "mark\ufeff", "separator\u2028x", "bytes\udcff\udc80")


def run_raw(*arguments, stdin=b""):
    """(exit code, what people would see)."""
    done = subprocess.run([os.fsencode(PROGRAM), *map(os.fsencode, arguments)], input=stdin, capture_output=True,
                          timeout=60, env=environment())
    return done.returncode, (done.stdout + done.stderr).decode("utf-8", "surrogateescape")


class HostileText(CommandTest):
    def clean(self, *arguments, stdin=b"", shows=None, codes=range(5)):
        code, text = run_raw(*arguments, stdin=stdin)
        self.assertIn(code, codes, (arguments, text))
        found = FORBIDDEN.search(text)
        self.assertIsNone(found, (arguments, found, text))
        if shows:
            self.assertIn(shows, text)

    def history(self, name, header="t,u1,u2"):
        path = os.path.join(os.fsencode(self.folder), os.fsencode(name))
        rows = self.rows_of("respond", "three-parameter", "--step", "0.1")
        with open(path, "wb") as file:
            extra = header.count(",") - 2
            file.write(os.fsencode(header) + b"\n")
            for row in rows:
                file.write(",".join([row["t"], row["u1"], row["u2"], *["0"] * extra]).encode() + b"\n")
        return os.fsdecode(path)

    def test_in_arguments(self):
        for text in HOSTILE:
            for command in (("list", text), ("show", text), ("explain", text), ("respond", text, "--samples", "3"),
                            ("verify", text), ("check", text), ("paper", text, "--out", self.path("x")), (text,),
                            ("--" + text,), ("list", "--" + text), ("list", "--format", text),
                            ("show", "stop", "--set", text), ("show", "stop", "--set", f"eta={text}"),
                            ("respond", "stop", "--times", text), ("respond", "stop", "--step", text),
                            ("verify", "--baseline", text), ("verify", "rk4:" + text), ("check", "x", "--expect", text),
                            ("list", "--out", f"/nowhere/{text}"), ("paper", "--out", f"/nowhere/{text}")):
                self.clean(*command, codes=(2, 4))

    def test_in_names_of_files(self):
        for text in HOSTILE:
            history = self.history(text)
            self.clean("check", history)
            self.clean("check", history, history)
            self.clean("check", history, "--events", history)
            self.clean("list", "cases", "--out", self.path(text + ".txt"))
            self.clean("respond", "stop", "--times", history, codes=(0,))

    def test_in_headers_and_rows(self):
        for text in HOSTILE:
            self.clean("check", self.history("h.csv", f"t,u1,u2,{text}"))
            self.clean("check", self.history("h.csv", f"t,{text},u2"))
            self.clean("check", "-", stdin=os.fsencode(f"t,u1,u2\n0,1,{text}\n"), codes=(2,))
            self.clean("respond", "stop", "--times", "-", stdin=os.fsencode(text + "\n"), codes=(2,))
            self.clean("verify", "--baseline", "-", stdin=os.fsencode(f'{{"{text}": 1}}'), codes=(2,))

    def test_in_databases(self):
        with open(self.path("spec.toml"), "w") as file:
            file.write('methods = ["rk4"]\n[ladder]\nlevels = 1\nsamples_per_level = 1\n[[cases]]\ncase = "stop"\n')
        path = self.path("rk4.db")
        self.good("atlas", "--specification", file.name, "--submit", "rk4", "--out", path, "--quiet")
        text = " ".join(HOSTILE[:-1])  # SQLite has UTF-8
        databases.change(path, ("UPDATE subjects SET reason = ?, refusal = ?, treatment = ?, claim = ?", (text,) * 4),
                         ("INSERT OR REPLACE INTO campaign VALUES ('author', ?), ('file', ?)", (text, text)))
        self.clean("campaign", "status", path, codes=(0,))
        self.clean("campaign", "export", path, "--table", "subjects", codes=(0,), shows=r"\x1b[31m")
        self.clean("campaign", "query", path, f"SELECT reason AS \"{text}\" FROM subjects", codes=(0,))
        self.clean("campaign", "query", path, f"SELECT \"{text}\"()", codes=(2,))
        self.clean("atlas", "--specification", file.name, "--merge", path, "--out", self.path("a"), codes=(0,))
        self.clean("campaign", "plan", path, codes=(2,))

    def test_in_problems_and_specifications(self):
        for text in (" ".join(HOSTILE[:-1]), HOSTILE[-1]):
            for content in (text, f'"{text}" = 1', f'methods = ["{text}"]\n[[cases]]\ncase = "{text}"',
                            f'{{"{text}": 1}}', f"dof={text}"):
                with open(self.path("x.toml"), "wb") as file:
                    file.write(os.fsencode(content))
                self.clean("campaign", "plan", file.name, codes=(2,))
                self.clean("respond", "--problem", file.name, "--samples", "3", codes=(2,))

    def test_is_shown_escaped(self):
        self.clean("list", "\x1b[31m", shows=r"\x1b[31m", codes=(2,))


if __name__ == "__main__":
    unittest.main()
