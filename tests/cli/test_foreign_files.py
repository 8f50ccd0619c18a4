"""Time histories as other programs and systems write them: where they come from, and what is no text."""
import gzip
import subprocess
import unittest

from command import PROGRAM, CommandTest, environment, rows


class ForeignFiles(CommandTest):
    def setUp(self):
        super().setUp()
        self.text = self.good("respond", "three-parameter", "--step", "0.1", "--format", "csv")

    def checked(self, *arguments, stdin=b""):
        done = subprocess.run([PROGRAM, "check", *arguments, "--format", "csv"], input=stdin, capture_output=True,
                              timeout=60, env=environment())
        self.assertEqual((done.returncode, done.stderr), (0, b""), arguments)
        return rows(done.stdout.decode())

    def without_name(self, table):
        return [{name: value for name, value in row.items() if name != "file"} for row in table]

    def test_from_standard_input_are_checked_like_files(self):
        with open(self.path("h.csv"), "w") as file:
            file.write(self.text)
        self.assertEqual(self.without_name(self.checked("-", stdin=self.text.encode())),
                         self.without_name(self.checked(self.path("h.csv"))))

    def test_line_ends_and_a_byte_order_mark_change_nothing(self):
        expected = self.checked("-", stdin=self.text.encode())
        for end in ("\r\n", "\r"):
            given = "\ufeff" + self.text.replace("\n", end)
            self.assertEqual(self.checked("-", stdin=given.encode()), expected)

    def test_rows_of_many_columns_are_read(self):
        lines = self.text.splitlines()
        wide = "\n".join([lines[0] + "".join(f",x{i}" for i in range(10000)),
                          *(line + ",0.12345678" * 10000 for line in lines[1:])]) + "\n"
        self.assertGreater(len(wide.splitlines()[1]), 65536)
        self.assertEqual(len(self.checked("-", stdin=wide.encode())), 1)

    def test_other_formats_are_named(self):
        for given, says in ((gzip.compress(self.text.encode()), "gzip"), (self.text.encode("utf-32"), "UTF-32"),
                            (self.text.encode("utf-16"), "UTF-16"), (b"PK\x03\x04", "spreadsheet")):
            with open(self.path("x"), "wb") as file:
                file.write(given)
            self.refused("check", self.path("x"), code="not-text", says=says)
            self.refused("respond", "stop", "--times", self.path("x"), code="not-text", says=says)
        with open(self.path("x"), "wb") as file:
            file.write(b"\x93NUMPY\x01")
        self.refused("respond", "stop", "--times", self.path("x"), code="not-an-array", says="header")

    def test_a_row_that_is_cut_short_is_refused_with_that_reason(self):
        cut = self.text[:self.text.rindex(",")]
        cut = cut[:cut.rindex(",")]
        self.refused("check", "-", stdin=cut, code="ragged-row", says="may have been cut")


if __name__ == "__main__":
    unittest.main()
