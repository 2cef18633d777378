"""Times other readers on the files of `cargo bench --bench reading`, in processor time.

    pip install polars pandas numpy
    TRUEPOSE_BENCH_FILES=target/bench-files cargo bench --bench reading
    python3 benches/compare/reading.py target/bench-files

Processor time (user + system) of the reading alone, all threads together, the median of nine runs
after a warm one. The program's own figure comes from `cargo bench`, where it runs in one thread.
"""
import json
import resource
import statistics
import sys

import numpy
import pandas
import polars


def cpu():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def median_ms(read):
    read()
    times = []
    for _ in range(9):
        start = cpu()
        read()
        times.append(1000 * (cpu() - start))
    return statistics.median(times)


folder = sys.argv[1]
for rows in (1_000, 100_000, 1_000_000):
    csv = f"{folder}/rows-{rows}.csv"
    inline = f"{folder}/inline-{rows}.json"
    print(f"{rows} rows of 10 columns, ms of processor time")
    for name, read in [
        ("polars", lambda: polars.read_csv(csv)),
        ("pandas", lambda: pandas.read_csv(csv)),
        ("numpy", lambda: numpy.loadtxt(csv, delimiter=",", skiprows=1)),
        ("json (Python)", lambda: json.load(open(inline, encoding="utf-8"))),
    ]:
        print(f"  {name:14} {median_ms(read):9.2f}")
