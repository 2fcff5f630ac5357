"""Work that is watched, ended and done side by side."""
import _thread
import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import hbvm

LONG = {"scene": "double_pendulum", "method": "hbvm:4,2", "step": "1/64", "until": 10**6}


def interrupted(work, after=0.3):
    """Ends the work by Ctrl-C, and returns the exception."""
    timer = threading.Timer(after, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt) as raised:
            work()
    finally:
        timer.join()
    return raised.value


def test_an_interrupted_run_keeps_what_it_has():
    end = interrupted(lambda: hbvm.run(**LONG))
    assert isinstance(end, hbvm.Interrupted) and "interrupted at t = " in str(end)
    kept = hbvm.kept()
    assert kept is end.trajectory and len(kept) > 10
    whole = hbvm.run(**{**LONG, "until": 1})
    n = min(len(kept), len(whole.trajectory))
    assert kept["a.x"].text[:n] == whole["a.x"].text[:n]


def test_other_work_is_interrupted():
    for work in (
        lambda: hbvm.reference("double_pendulum", at=1000, digits=500, force=True),
        lambda: hbvm.audit("paper:full"),
        lambda: hbvm.cost("double_pendulum", digits=300, until=100),
        lambda: hbvm.compare("double_pendulum", ["verlet", "rk4"], step="1/64", until=10**6),
        lambda: hbvm.convergence("double_pendulum", ["hbvm:4,2"], steps="1/8:1/65536", until=1000),
    ):
        interrupted(work)


def test_after_an_interruption_all_is_as_before():
    before = signal.getsignal(signal.SIGINT)
    interrupted(lambda: hbvm.run(**LONG), after=0.1)
    assert signal.getsignal(signal.SIGINT) is before
    with pytest.raises(KeyboardInterrupt):
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(5)
    assert hbvm.run(**{**LONG, "until": 1}).steps == 64


def test_handlers_of_other_signals_are_called_while_a_run_goes_on():
    class Enough(Exception):
        pass

    def handler(*_):
        raise Enough

    before = signal.signal(signal.SIGALRM, handler)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(Enough):
            hbvm.run(**LONG)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_a_run_that_cannot_go_on_keeps_what_it_has():
    falling = hbvm.Scene(1).body("a", position=[1]).effect("formula", U="-sqrt(x)")
    with pytest.raises(hbvm.IntegrationError) as raised:
        hbvm.run(falling, "hbvm:4,2", step="1/16", until=50)
    assert raised.value.trajectory is hbvm.kept() and len(hbvm.kept()) > 3


def test_progress_is_told():
    told = []
    hbvm.run(**{**LONG, "until": 200}, progress=lambda done, of: told.append((done, of)))
    assert told[-1] == (200 * 64, 200 * 64)
    assert [done for done, _ in told] == sorted(done for done, _ in told)
    parts = []
    hbvm.reference("double_pendulum", at=10, digits=200, progress=lambda done, of: parts.append(done / of))
    assert len(parts) > 3 and all(0 <= part <= 1 for part in parts) and max(parts) > 0.5


def test_an_exception_of_progress_ends_the_run():
    class Enough(Exception):
        pass

    def progress(done, of):
        raise Enough("seen enough")

    with pytest.raises(Enough, match="seen enough"):
        hbvm.run(**LONG, progress=progress)


def test_a_bar_is_drawn_by_tqdm(capsys):
    pytest.importorskip("tqdm")
    hbvm.run(**{**LONG, "until": 20}, progress=True)
    assert "double_pendulum" in capsys.readouterr().err


def test_eight_threads_have_eight_precisions():
    precisions = ["double", "quad", *(f"mpfr:{digits}" for digits in (20, 30, 50, 80, 120, 200))]

    def run(precision):
        return hbvm.run("double_pendulum", "hbvm:4,2", step="1/32", until=2, precision=precision).to_csv()

    alone = [run(precision) for precision in precisions]
    with ThreadPoolExecutor(8) as pool:
        for _ in range(3):
            assert list(pool.map(run, precisions)) == alone


def test_other_threads_of_python_go_on_beside_a_run():
    counted = 0
    ready = threading.Event()

    def count():
        nonlocal counted
        ready.set()
        while counted < 1000:
            counted += 1

    def progress(done, of):
        threading.Thread(target=count).start()
        ready.wait()
        _thread.interrupt_main()

    with pytest.raises(KeyboardInterrupt):
        hbvm.run(**LONG, progress=progress)
    assert counted > 0


def test_memory_stays_flat():
    """Also where threads begin and end. What the first runs take is kept for the next ones."""
    code = """
import resource, threading, tracemalloc, hbvm
def work():
    run = hbvm.run("double_pendulum", "hbvm:4,2", step="1/8", until=2, precision=30)
    run["a.x"].exact
def rss():
    return int(open("/proc/self/statm").read().split()[1]) * resource.getpagesize()
def many(n):
    for _ in range(n):
        work()
    thread = threading.Thread(target=work); thread.start(); thread.join()
many(300)
tracemalloc.start()
many(20)
before, traced = rss(), tracemalloc.get_traced_memory()[0]
many(300)
print(rss() - before, tracemalloc.get_traced_memory()[0] - traced)
"""
    said = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    grown, traced = (int(word) for word in said.split())
    assert grown < 2_000_000 and traced < 50_000
