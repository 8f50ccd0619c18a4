"""The ladder that verify gives each case, and what refinement adds to it."""
import json

from command import PANEL, CommandTest, run

LONG = 300  # seconds, on a loaded machine
AMPLE = ("--budget", "10min")  # never spent: what is decided must not depend on the machine's speed


class DefaultLadder(CommandTest):
    def test_all_of_the_panel_agree_for_every_ratio_of_masses(self):
        for N, coarsest in ((0, 0.45), (1, 0.09), (2, 0.05), (5, 0.021), (20, 0.0055), (100, 0.0011)):
            with self.subTest(N=N):
                done = run("verify", "--set", f"N={N}", *AMPLE, "--format", "json", timeout=LONG)
                case, = json.loads(done.stdout)["cases"]
                self.assertEqual({s["name"]: s["assessment"]["verdict"] for s in case["subjects"]},
                                 {name: "agrees" for name in PANEL})
                self.assertEqual(case["plan"]["coarsest"], coarsest)
                self.assertEqual(done.returncode, 0)


class Refinement(CommandTest):
    def test_refines_what_is_undecided_and_says_so(self):
        subject, = self.subjects("newmark:beta=0.5,gamma=1", *AMPLE)
        self.assertEqual(subject["assessment"]["verdict"], "agrees")
        self.assertGreater(subject["refinement"]["finer_levels"], 0)
        self.assertEqual(len(subject["levels"]), 8 + subject["refinement"]["finer_levels"])
        self.assertEqual(subject["refinement"]["end"], "decided")

    def test_a_stiff_contact_gets_the_steps_that_resolve_it(self):
        subject, = self.subjects("newmark+penalty:stiffness=1e5", *AMPLE)
        self.assertEqual(subject["assessment"]["verdict"], "agrees")
        resolved = [level for level in subject["levels"] if level["step"] <= subject["contact_time"] / 25]
        self.assertGreaterEqual(len(resolved), 1)

    def test_levels_that_are_asked_for_are_those_that_are_run(self):
        subject, = self.subjects("rk4", "--levels", "2", "--samples-per-level", "1")
        self.assertEqual((len(subject["levels"]), subject["refinement"]), (2, None))
        subject, = self.subjects("rk4", "--levels", "2", "--samples-per-level", "1", *AMPLE)
        self.assertEqual(subject["assessment"]["verdict"], "agrees")
        self.assertGreater(len(subject["levels"]), 2)

    def test_a_budget_that_is_too_small_ends_refinement(self):
        subject, = self.subjects("newmark+penalty:stiffness=1e9", "--budget", "1")
        self.assertEqual(subject["refinement"]["end"], "budget")
        self.assertGreater(subject["refinement"]["next_seconds"], 0.5)
        subject, = self.subjects("newmark+penalty:stiffness=1e9", "--budget", "0")
        self.assertIsNone(subject["refinement"])
        self.refused("verify", "rk4", "--budget", "-1", code="out-of-range", says="--budget")
        self.refused("verify", "rk4", "--budget", "1day", code="not-a-number", says="--budget")

    def subjects(self, *arguments):
        done = run("verify", *arguments, "--format", "json", timeout=LONG)
        return json.loads(done.stdout)["cases"][0]["subjects"]
