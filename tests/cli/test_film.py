"""Films of a motion: what they hold, and who is missing."""

import os
import pathlib
import subprocess
import tempfile
import unittest

from command import PROGRAM


def frames_of(film):
    shown = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries",
                            "stream=nb_read_frames,width,height", "-of", "csv=p=0", film],
                           capture_output=True, text=True, check=True)
    width, height, frames = map(int, shown.stdout.strip().split(","))
    return width, height, frames


class Film(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.temporary = self.folder / "tmp"
        self.temporary.mkdir()

    def film(self, *arguments, path=None):
        environment = {**os.environ, "TMPDIR": str(self.temporary), "PATH": path or os.environ["PATH"]}
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                              env=environment)
        self.assertEqual(list(self.temporary.iterdir()), [], "a folder is left behind")
        return done

    def test_of_the_exact_motion(self):
        file = self.folder / "stop.webm"
        done = self.film("respond", "stop", "--set", "t_end=2", "--film", file)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assertIn(f"Wrote {file}", done.stderr)
        self.assertEqual(frames_of(file), (1000, 300, 100))  # four seconds

    def test_of_methods_beside_it(self):
        file = self.folder / "pair.gif"
        done = self.film("verify", "--case", "stop", "--set", "t_end=2", "newmark", "rk4+reversal",
                         "--film", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        width, height, frames = frames_of(file)
        self.assertEqual((width, height), (640, 192))
        self.assertGreater(frames, 50)  # frames that are alike may be one

    def test_needs_its_programs(self):
        for have, missing in (((), "node"), (("node",), "rsvg-convert"),
                              (("node", "rsvg-convert"), "ffmpeg")):
            folder = self.folder / f"path-{missing}"
            folder.mkdir()
            for name in ("sh", *have):
                found = subprocess.run(["which", name], capture_output=True, text=True, check=True)
                (folder / name).symlink_to(found.stdout.strip())
            file = self.folder / "none.gif"
            done = self.film("respond", "stop", "--set", "t_end=2", "--film", file, path=str(folder))
            self.assertEqual(done.returncode, 4)
            self.assertIn(f"there is no program {missing} on the PATH", done.stderr)
            self.assertIn("[no-renderer]", done.stderr)
            self.assertFalse(file.exists())

    def test_is_refused_for_what_has_none(self):
        for arguments, code, word in (
                (("respond", "stop", "--film", self.folder / "a.mp4"), 2, "FILE.webm or FILE.gif"),
                (("respond", "assembly", "--film", self.folder / "a.gif"), 4, "no drawing that moves"),
                (("verify", "stop", "sdof", "rk4", "--film", self.folder / "a.gif"), 2, "one case"),
                (("respond", "stop", "--film", self.folder / "no" / "a.gif"), 4, "cannot write")):
            done = self.film(*arguments)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
