"""clackers campaign: plan, run, status, merge, export, query, and what they refuse."""
import json
import os
import random
import resource
import signal
import sqlite3
import subprocess
import unittest

import databases
from command import PROGRAM, CommandTest, environment, rows, run, start

SPEC = """methods = ["newmark", "rk4", "newmark+penalty"]
[ladder]
levels = 2
samples_per_level = 2
[[cases]]
case = "stop"
set = { eta = [0.5, 1], t_end = { from = 2, to = 4, points = 3 } }
"""
TASKS = 18
# Tasks that take a while.
LONG = """methods = ["rk4"]
[ladder]
levels = 5
coarsest = 2e-3
[[cases]]
case = "stop"
set = { xi1 = { from = 0, to = 0.1, points = 2000 } }
"""


class Campaign(CommandTest):
    def setUp(self):
        super().setUp()
        self.spec, self.database = self.path("spec.toml"), self.path("runs.db")
        self.write("spec.toml", SPEC)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def run_spec(self, *options, **more):
        return self.good("campaign", "run", self.spec, "--database", self.database, *options, **more)

    def exported(self, database=None, *options):
        return self.good("campaign", "export", database or self.database, "--format", "csv", *options)

    def status(self, database=None):
        found = self.rows_of("campaign", "status", database or self.database)
        return {row["quantity"]: row["value"] for row in found}

    @staticmethod
    def remove_tasks(database, condition):
        databases.change(database, *(f"DELETE FROM {table} WHERE {condition}" for table in ("runs", "timings", "subjects")))

    def count(self, sql):
        with sqlite3.connect(self.database) as database:
            return database.execute(sql).fetchone()[0]


class Use(Campaign):
    def test_plan_counts_and_estimates(self):
        plan = {row["quantity"]: row for row in self.rows_of("campaign", "plan", self.spec)}
        self.assertEqual(plan["systems"]["value"], "6")
        self.assertEqual(plan["tasks"]["value"], str(TASKS))
        # The penalty method refuses eta = 0.5.
        self.assertEqual(plan["runs"]["value"], str((TASKS - 3) * 4))
        self.assertGreater(float(plan["processor_time"]["value"]), 0)
        self.assertGreater(float(plan["disk"]["value"]), 1000)
        self.assertEqual(self.files(), ["spec.toml"])

    def test_run_goes_on_where_it_stopped_and_says_how_far_it_is(self):
        self.run_spec()
        self.assertEqual(self.files(), ["runs.db", "spec.toml"])
        status = self.status()
        self.assertEqual((status["tasks"], status["finished"]), (str(TASKS), str(TASKS)))
        self.assertEqual(status["refused"], "3")
        self.assertEqual(status["next"], f"clackers campaign export {self.database} --format csv --out runs.csv")
        before = self.exported()
        self.remove_tasks(self.database, "task % 3 = 1")
        self.assertEqual(self.status()["next"], f"clackers campaign run {self.spec} --database {self.database}")
        self.run_spec()
        self.assertEqual(self.exported(), before)

    def test_database_has_the_name_of_the_specification_in_the_current_folder(self):
        os.mkdir(self.path("here"))
        self.good("campaign", "run", "../spec.toml", "--quiet", cwd=self.path("here"))
        self.assertEqual((self.files(), os.listdir(self.path("here"))), (["here", "spec.toml"], ["spec.db"]))

    def test_rows_are_the_same_for_any_jobs_and_shards(self):
        self.run_spec("--jobs", "1")
        expected = self.exported()
        for jobs in ("2", "4"):
            other = self.path(f"jobs{jobs}.db")
            self.good("campaign", "run", self.spec, "--database", other, "--jobs", jobs)
            self.assertEqual(self.exported(other), expected)
        parts = self.path("parts.db")
        for i in (3, 1, 2):
            self.good("campaign", "run", self.spec, "--database", parts, "--shard", f"{i}/3")
        part = parts + ".shard-2-of-3"
        status = self.status(part)
        self.assertEqual((status["tasks"], status["finished"], status["shard"]), ("6", "6", "2/3"))
        self.assertEqual(status["next"], f"clackers campaign merge {parts}")
        self.remove_tasks(part, "task = (SELECT max(task) FROM digests)")
        self.assertEqual(self.status(part)["next"],
                         f"clackers campaign run {self.spec} --database {parts} --shard 2/3")
        self.good("campaign", "run", self.spec, "--database", parts, "--shard", "2/3")
        done = run("campaign", "merge", parts)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("shard-1-of-3: 6 tasks added", done.stderr)
        self.assertEqual(self.exported(parts), expected)
        self.assertEqual(self.exported(parts, "--table", "subjects"), self.exported(self.database, "--table", "subjects"))

    def test_export_has_verify_columns_and_times_on_request(self):
        self.run_spec()
        table = rows(self.exported())
        self.assertEqual(len(table), (TASKS - 3) * 4 + 3)
        self.assertEqual([(row["task"], row["run"]) for row in table[:5]],
                         [("0", "1"), ("0", "2"), ("0", "3"), ("0", "4"), ("1", "1")])
        verify = rows(run("verify", "rk4", "--case", "stop", "--set", "eta=0.5,t_end=2", "--levels", "2",
                          "--samples-per-level", "2", "--format", "csv").stdout)
        for ours, theirs in zip([row for row in table if row["task"] == "1"], verify, strict=True):
            for name in theirs:
                # Metrics of verify are those of the specification here.
                if name not in ("seconds", "reused") and not name.startswith("metric:"):
                    self.assertEqual(ours[name], theirs[name], name)
        self.assertNotIn("seconds", table[0])
        timed = rows(self.exported(None, "--times"))
        self.assertGreater(float(timed[0]["seconds"]), 0)
        subjects = rows(self.exported(None, "--table", "subjects"))
        self.assertEqual([row["task"] for row in subjects], [str(i) for i in range(TASKS)])
        self.assertEqual({row["refusal_code"] for row in subjects}, {"", "penalty-needs-elastic"})

    def test_export_as_json_and_as_numpy(self):
        self.run_spec()
        table = json.loads(self.good("campaign", "export", self.database, "--format", "json"))
        self.assertEqual(table["schema"], "clackers/campaign-runs/1")
        self.assertEqual(len(table["rows"]), len(rows(self.exported())))
        try:
            import numpy
        except ImportError:
            self.skipTest("no NumPy")
        run("campaign", "export", self.database, "--format", "npy", "--out", self.path("runs.npy"))
        numbers = numpy.load(self.path("runs.npy"))
        self.assertEqual(len(numbers), len(table["rows"]))
        self.assertNotIn("method", numbers.dtype.names)
        for row, text in zip(numbers, rows(self.exported())):
            for name in ("task", "set_eta", "u_error"):
                self.assertEqual(str(row[name]), str(float(text[name] or "nan")))

    def test_query_prints_what_sql_selects(self):
        self.run_spec()
        table = self.rows_of("campaign", "query", self.database,
                             "SELECT method, count(*) AS tasks FROM subjects GROUP BY method ORDER BY method")
        self.assertEqual(table, [{"method": m, "tasks": "6"} for m in ("newmark", "newmark+penalty", "rk4")])

    def test_example_runs(self):
        spec = os.path.join(os.path.dirname(__file__), "../../examples/campaigns/pairs.toml")
        self.good("campaign", "run", os.path.abspath(spec), "--database", self.database)
        verdicts = self.status()
        self.assertEqual(verdicts["tasks"], verdicts["finished"])
        self.assertGreater(int(verdicts["agrees"]), int(verdicts["tasks"]) // 2)

    def test_all_methods_may_stand_without_brackets(self):
        counts = []
        for methods in ('"all"', '["all"]'):
            self.write("spec.toml", f'methods = {methods}\n[ladder]\nlevels = 1\n[[cases]]\ncase = "stop"\n')
            counts.append(self.rows_of("campaign", "plan", self.spec)[1])
        self.assertEqual(counts[0], counts[1])
        self.assertGreater(int(counts[0]["value"]), 20)

    def test_programs_are_methods(self):
        solver = os.path.join(os.path.dirname(__file__), "../../examples/solvers/midpoint.py")
        self.write("spec.toml", 'methods = ["rk4", { exec = "python3 %s {case} {h} {out} {events}", name = "mine", '
                   'expect = "proper:2" }]\n[ladder]\nlevels = 1\nsamples_per_level = 2\n[[cases]]\ncase = "stop"\n'
                   'set = { t_end = 2 }\n' % os.path.abspath(solver))
        self.run_spec()
        found = rows(self.exported())
        self.assertEqual([row["method"] for row in found], ["rk4", "rk4", "mine", "mine"])
        self.assertTrue(all(row["finished"] == "yes" and row["u_error"] for row in found))

    def test_interrupt_keeps_what_is_finished(self):
        long = self.write("long.toml", LONG)
        process = start("campaign", "run", long, "--database", self.database, stdout=subprocess.PIPE,
                        stderr=subprocess.PIPE, text=True)
        self.wait_for(lambda: os.path.exists(self.database) and os.path.getsize(self.database) > 0)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("[interrupted]", err)
        self.assertIn("finished", out)
        status = self.status()
        self.assertLess(int(status["finished"]), 2000)
        self.assertEqual(self.count("SELECT count(*) FROM runs"), 40 * int(status["finished"]))
        self.assertEqual(self.files(), ["long.toml", "runs.db", "spec.toml"])

    def test_kill_keeps_what_was_stored_and_the_rows_are_the_same(self):
        self.run_spec()
        expected = self.exported()
        for _ in range(5):
            process = start("campaign", "run", self.spec, "--database", self.path("killed.db"), "--jobs", "2",
                            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                process.wait(0.03)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.good("campaign", "run", self.spec, "--database", self.path("killed.db"))
        self.assertEqual(self.exported(self.path("killed.db")), expected)


ENDLESS = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x+1 FROM c) SELECT count(*) FROM c"


class Hostile(Campaign):
    """Databases of strangers, and damaged ones."""

    def test_interrupt_ends_a_query_at_once(self):
        self.run_spec()
        for number in (signal.SIGINT, signal.SIGTERM):
            process = start("campaign", "query", self.database, ENDLESS, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)
            self.wait_for(lambda: self.database in self.open_files(process))
            process.send_signal(number)
            out, err = process.communicate(timeout=10)
            self.assertEqual((process.returncode, out), (130, ""))
            self.assertIn("[interrupted]", err)

    def test_views_are_refused_by_every_command(self):
        self.run_spec()
        with sqlite3.connect(self.database) as database:
            database.execute("DROP TABLE subjects")
            database.execute(f"CREATE VIEW subjects AS {ENDLESS}")
        for arguments in (("status", self.database), ("export", self.database), ("merge", self.path("a.db"), self.database),
                          ("report", self.database, "--out", self.path("a.html")), ("query", self.database, "SELECT 1"),
                          ("run", self.spec, "--database", self.database)):
            self.refused("campaign", *arguments, code="not-a-campaign", says="view subjects")
        self.assertEqual(self.files(), ["runs.db", "spec.toml"])

    def test_statements_without_rows_are_refused(self):
        self.run_spec()
        for statement in ("BEGIN", "SAVEPOINT a", "PRAGMA query_only=0", "PRAGMA table_i", "-- nothing", "--nothing at all", ";"):
            for form in ("table", "csv", "json"):
                self.refused("campaign", "query", self.database, statement, "--format", form, code="bad-syntax")
        for statement in ("SELECT 1 AS x; -- a comment", "-- x = 1\nSELECT 1 AS x"):
            self.assertEqual(self.rows_of("campaign", "query", self.database, statement), [{"x": "1"}])

    def test_the_page_of_a_campaign_ends_in_html(self):
        self.run_spec()
        self.refused("campaign", "report", self.database, "--out", self.path("x.pdf"), code="bad-syntax", says=("--out = ", "FILE.html"))

    def test_values_of_other_types_are_no_mistake_of_ours(self):
        self.run_spec()
        databases.change(self.database, "UPDATE subjects SET verdict = NULL WHERE task = 1",
                         "UPDATE subjects SET verdict = 7 WHERE task = 2", "UPDATE runs SET u_error = 'x'")
        self.assertEqual(self.status()["finished"], str(TASKS))
        for arguments in (("export", self.database), ("run", self.spec, "--database", self.database),
                          ("report", self.database, "--out", self.path("a.html"))):
            done = run("campaign", *arguments)
            self.assertIn(done.returncode, (0, 2), done.stderr)
            self.assertNotIn("internal-error", done.stderr)

    def outcome(self, database, *arguments):
        done = run("campaign", *arguments, database, "--format", "csv")
        self.assertNotIn("internal-error", done.stderr)
        self.assertEqual(done.returncode == 0, done.stderr == "", done.stderr)
        return done.stdout if done.returncode == 0 else None

    def test_flipped_bytes_are_noticed_or_change_nothing(self):
        self.run_spec()
        asked = (("export",), ("export", "--table", "subjects", "--times"))
        other = self.path("other.db")
        with open(self.database, "rb") as file:
            whole = file.read()
        with open(other, "wb") as file:
            file.write(whole)
        expected = [self.outcome(other, *arguments) for arguments in asked]
        chance, noticed = random.Random(22), 0
        for _ in range(24):
            flipped = bytearray(whole)
            flipped[chance.randrange(len(whole))] ^= 1 << chance.randrange(8)
            with open(other, "wb") as file:
                file.write(flipped)
            for arguments, text in zip(asked, expected):
                found = self.outcome(other, *arguments)
                self.assertIn(found, (None, text))
                noticed += found is None
            self.outcome(other, "status")
        self.assertGreater(noticed, 4)

    def test_killed_writer_on_a_read_only_medium(self):
        """SQLite cannot put the log in order there; the message says what to do."""
        if os.geteuid() == 0 and not os.path.exists("/usr/sbin/setpriv") and not os.path.exists("/usr/bin/setpriv"):
            self.skipTest("root may write everywhere")
        self.run_spec()
        with sqlite3.connect(self.database) as database:
            database.execute("PRAGMA journal_mode = WAL")
        database.close()
        os.chmod(self.database, 0o444)
        os.chmod(self.folder, 0o555)
        self.addCleanup(os.chmod, self.folder, 0o755)
        command = [PROGRAM, "campaign", "status", self.database]
        if os.geteuid() == 0:
            command = ["setpriv", "--reuid", "65534", "--clear-groups", *command]
        done = subprocess.run(command, capture_output=True, text=True, timeout=60, env=environment())
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("copy it", done.stderr)


class BadInput(Campaign):
    def refused_spec(self, text, *says, code):
        self.refused("campaign", "run", self.write("bad.toml", text), code=code, says=says)
        self.assertNotIn("bad.db", self.files())

    def test_specifications(self):
        self.refused_spec(SPEC.replace("methods", "metods"), "bad.toml:1", 'Did you mean "methods"?', code="unknown-name")
        self.refused_spec(SPEC.replace("rk4", "rk44"), "bad.toml:1", "rk4", code="unknown-name")
        self.refused_spec(SPEC.replace(", points = 3", ""), "the range of t_end has no points", code="no-column")
        self.refused_spec("methods = [", "bad.toml:1", code="bad-syntax")
        self.refused("campaign", "run", self.path("none.toml"), code="cannot-read", exit_code=4)

    def test_a_trillion_runs_need_yes(self):
        text = SPEC.replace("points = 3", "points = 1e11")
        self.refused_spec(text, "runs, about", "hours of one processor", "GB", "--yes", code="too-many-runs")
        plan = {row["quantity"]: row["value"] for row in self.rows_of("campaign", "plan", self.write("big.toml", text))}
        self.assertEqual(plan["tasks"], "600000000000")

    def test_actions_and_options(self):
        self.refused("campaign", code="bad-syntax", says="needs an action: plan, run")
        self.refused("campaign", "rnu", self.spec, code="unknown-name", says='Did you mean "run"?')
        self.refused("campaign", "run", code="bad-syntax", says="SPEC.toml")
        self.refused("campaign", "status", code="bad-syntax", says="DATABASE")
        self.refused("campaign", "plan", self.spec, "--jobs", "2", code="bad-syntax", says="takes no --jobs")
        self.refused("campaign", "plan", self.spec, self.spec, code="bad-syntax", says="one argument too many")
        self.refused("campaign", "run", self.spec, "--shard", "4/3", code="out-of-range", says="1 <= i <= n")
        self.refused("campaign", "run", self.spec, "--jobs", "0", code="out-of-range", cwd=self.folder)
        self.assertEqual(self.files(), ["spec.toml"])
        self.run_spec()
        self.refused("campaign", "export", self.database, "--table", "rums", code="unknown-name", says='"runs"')
        self.refused("campaign", "query", self.database, code="bad-syntax", says="SELECT")
        self.refused("campaign", "query", self.database, "SELECT something FROM runs", code="bad-syntax",
                     says="no such column")
        self.refused("campaign", "query", self.database, "DELETE FROM runs", code="bad-syntax", says="that reads")
        self.refused("campaign", "status", self.database, "--format", "npy", code="unknown-name")

    def test_databases(self):
        self.refused("campaign", "status", self.path("none.db"), code="cannot-read", exit_code=4, says="campaign run")
        self.refused("campaign", "status", self.spec, code="not-a-campaign", says="spec.toml")
        self.run_spec()
        other = self.write("other.toml", SPEC.replace("rk4", "central-difference"))
        self.refused("campaign", "run", other, "--database", self.database, code="other-campaign",
                     says=("--database", "campaign query"))
        with sqlite3.connect(self.database) as database:
            database.execute("PRAGMA user_version = 7")
        self.refused("campaign", "run", self.spec, "--database", self.database, code="other-version", says="version 7")
        with sqlite3.connect(self.database) as database:
            database.execute("PRAGMA user_version = 2")
        with open(self.database, "r+b") as file:
            file.truncate(os.path.getsize(self.database) // 2)
        for action in (("run", self.spec, "--database", self.database), ("status", self.database),
                       ("export", self.database)):
            self.refused("campaign", *action, code="not-a-campaign", says="half written")

    def test_two_writers(self):
        long = self.write("long.toml", LONG)
        first = start("campaign", "run", long, "--database", self.database, stdout=subprocess.DEVNULL,
                      stderr=subprocess.DEVNULL)
        try:
            self.wait_for(lambda: os.path.exists(self.database) and os.path.getsize(self.database) > 0)
            self.refused("campaign", "run", long, "--database", self.database, code="database-busy",
                         says="another process writes")
            self.status()  # readers are welcome
        finally:
            first.kill()
            first.wait()

    def test_missing_shards(self):
        self.refused("campaign", "merge", self.database, code="cannot-read", exit_code=4, says="no shards beside it")
        for i in (1, 4):
            self.run_spec("--shard", f"{i}/4")
        self.refused("campaign", "merge", self.database, code="shard-missing",
                     says=("2 of 4 shards missing: 2/4, 3/4.", "--shard 2/4"))
        self.run_spec("--shard", "999999/1000000")
        said = self.refused("campaign", "merge", self.path("new.db"), self.database + ".shard-999999-of-1000000",
                            code="shard-missing", says="999999 of 1000000 shards missing: 1/1000000")
        self.assertFalse(os.path.exists(self.path("new.db")))
        self.assertLess(len(said), 600)

    def test_full_disk_loses_nothing_that_was_stored(self):
        self.write("spec.toml", SPEC.replace("points = 3", "points = 40"))
        done = run("campaign", "run", self.spec, "--database", self.database,
                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000)))
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertRegex(done.stderr, r"\Aclackers: .*cannot be written; is the disk full\?.* \[cannot-write\]\n\Z")
        self.good("campaign", "run", self.spec, "--database", self.database)
        self.good("campaign", "run", self.spec, "--database", self.path("undisturbed.db"))
        self.assertEqual(self.exported(), self.exported(self.path("undisturbed.db")))


if __name__ == "__main__":
    unittest.main()
