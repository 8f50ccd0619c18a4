"""What the built command prints, to compare with."""
import io
import os
import subprocess

import pandas


def rows_of_command(*arguments):
    """The csv of the command as a DataFrame; numbers read back to the same double."""
    done = subprocess.run([os.environ["CLACKERS"], *arguments, "--format", "csv"], capture_output=True, text=True, check=True)
    return pandas.read_csv(io.StringIO(done.stdout), float_precision="round_trip", keep_default_na=False)
