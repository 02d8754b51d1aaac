"""Which kernel of OpenBLAS the program runs: the processor's, or the one that the user names."""

import os
import subprocess

import pytest

import launch

# Of those with AVX2 and fused multiply-add, and what OpenBLAS calls them.
FAST = {"Haswell", "Zen", "Excavator", "SkylakeX", "Cooperlake", "SapphireRapids"}


def kernel(named=None):
    """The last word of --version, with OPENBLAS_CORETYPE as `named` or unset."""
    environment = {key: value for key, value in os.environ.items() if key != "OPENBLAS_CORETYPE"}
    if named:
        environment["OPENBLAS_CORETYPE"] = named
    run = subprocess.run([launch.MORTISE, "--version"], env=environment, capture_output=True, text=True, check=True)
    return run.stdout.split()[-1]


def processor_flags():
    with open("/proc/cpuinfo", encoding="ascii") as file:
        return next((set(line.split()) for line in file if line.startswith("flags")), set())


@pytest.mark.skipif(not {"avx2", "fma"} <= processor_flags(), reason="a processor without AVX2")
def test_a_processor_with_avx2_uses_it():
    assert kernel() in FAST


@pytest.mark.parametrize("named", ["Prescott", "Nehalem"])
def test_a_kernel_that_the_user_names_is_kept(named):
    assert kernel(named) == named
