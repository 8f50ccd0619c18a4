"""Changes the database of a campaign as somebody would who knows how its digests are made; a second
implementation of clackers/campaign/store/digest.cpp."""
import contextlib
import sqlite3
import struct

MASK = (1 << 64) - 1


def mixed(bits, word):
    bits = ((bits << 23 | bits >> 41) & MASK ^ word) * 0x9e3779b97f4a7c15 & MASK
    return bits ^ bits >> 32


def words_of(cell):
    if cell is None or cell != cell:
        return [1]
    if isinstance(cell, str):
        text = cell.encode()
        padded = text + bytes(-len(text) % 8)
        return [4 + 8 * len(text), *struct.unpack(f"<{len(padded) // 8}Q", padded)]
    if isinstance(cell, int) and abs(cell) >= 1 << 53:
        return [3, cell & MASK]
    return [2, struct.unpack("<Q", struct.pack("<d", float(cell) + 0.0))[0]]


def digest(cells):
    bits = 0
    for cell in cells:
        for word in words_of(cell):
            bits = mixed(bits, word)
    return bits - (1 << 64) if bits >> 63 else bits


def digests_of(database):
    """The rows of the table `digests`."""
    for (task,) in database.execute("SELECT task FROM subjects ORDER BY task").fetchall():
        tables = [[cell for row in database.execute(f"SELECT * FROM {table} WHERE task = ? ORDER BY 2", (task,))
                   for cell in row[1:]] for table in ("subjects", "runs", "timings")]
        (runs,) = database.execute("SELECT count(*) FROM runs WHERE task = ?", (task,)).fetchone()
        yield task, runs, *(digest([task, runs, *cells]) for cells in tables)


def change(path, *statements):
    """A statement may be a pair with its parameters."""
    with contextlib.closing(sqlite3.connect(path)) as database, database:
        for statement in statements:
            database.execute(*([statement] if isinstance(statement, str) else statement))
        digests = list(digests_of(database))
        database.execute("DELETE FROM digests")
        database.executemany("INSERT INTO digests VALUES (?, ?, ?, ?, ?)", digests)
        kept = database.execute("SELECT key, value FROM campaign WHERE key != 'digest' ORDER BY key").fetchall()
        seal = digest([0, 0, *(cell for row in kept for cell in row)])
        database.execute("UPDATE campaign SET value = ? WHERE key = 'digest'", (f"{seal & MASK:016x}",))
