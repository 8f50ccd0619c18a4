"""Runs the built command."""
import json
import subprocess


class Command:
    def __init__(self, program):
        self.program = program

    def text(self, *arguments):
        """Standard output of a command that must succeed."""
        done = subprocess.run([self.program, *arguments], capture_output=True, text=True)
        if done.returncode != 0:
            raise SystemExit(f"clackers {' '.join(arguments)}: exit code {done.returncode}\n{done.stderr}")
        return done.stdout

    def json(self, *arguments):
        return json.loads(self.text(*arguments, "--format", "json"))
