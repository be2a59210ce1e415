"""tests/gauge.py: what the tests over sources print, and their exit code."""


def report(cases):
    """Prints each (name, faults); 1 if there are any faults."""
    failed = 0
    for name, faults in cases:
        print(f"{'FAILED' if faults else 'ok    '} {name}")
        for fault in faults:
            print(f"    {fault}")
        failed += bool(faults)
    print(f"{len(cases) - failed} passed, {failed} failed")
    return 1 if failed else 0
