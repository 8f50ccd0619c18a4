"""Histories by CalculiX with a compression-only penalty spring, without damping."""
import shutil
import unittest

import calculix
import calculix_pair
from peers import PeerTest, pair, runs

CASE = ("--set", "xi1=0")


@unittest.skipUnless(shutil.which("ccx"), "needs calculix-ccx")
class Calculix(PeerTest):
    @classmethod
    def setUpClass(cls):
        calculix.on_one_processor()

    def setUp(self):
        super().setUp()
        self.pair = pair("xi1=0")

    def history(self, stiffness, step, end=None):
        path = self.path(f"k{stiffness:g}-h{step:g}.txt")
        calculix_pair.run(self.folder, self.pair, stiffness, step,
                          self.pair["t_end"] if end is None else end, path)
        return path

    def test_stiff_contact_has_all_impacts_late_by_the_contacts(self):
        subject = self.checked(self.history(1e4, 0.004), *CASE)
        run = runs(subject)[0]
        self.assertEqual(subject["assessment"]["verdict"], "not claimed")
        # Each contact lasts 0.0157 s and delays what follows by as much: 0.079 s at the sixth.
        self.assert_six_impacts(run, 0.11)
        self.assertGreater(run["impacts"]["worst_time_error"], 0.07)
        self.assertEqual(run["file"]["collision_source"], "history")
        self.assertEqual({c["digits"] for c in run["file"]["columns"] if c["name"] != "t"}, {7})

    def test_error_of_soft_contact_stagnates(self):
        # Contacts of pi sqrt(0.25 / 900) = 0.0524 s, 26 of the finest steps.
        # The first two impacts: a run of 6 s.
        case = ("--set", "xi1=0,a_t=0.3")
        files = [self.history(900.0, 0.016 / 2**n, end=6.0) for n in range(4)]
        subject = self.checked(*files, *case, "--expect", "stagnating")
        self.assertEqual(subject["assessment"]["displacement"]["reason"], "contact-stiffness")
        self.assertAlmostEqual(runs(subject)[-1]["file"]["contact_time"], 0.0524, delta=0.004)
        self.checked(*files, *case, "--expect", "proper:2", exit_code=1)

    def test_too_soft_contact_disagrees(self):
        subject = self.checked(self.history(30.0, 0.005), *CASE, exit_code=1)
        self.assertEqual(subject["assessment"]["verdict"], "disagrees")


if __name__ == "__main__":
    unittest.main()
