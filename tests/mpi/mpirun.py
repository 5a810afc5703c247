# SPDX-License-Identifier: BSD-3-Clause
"""Runs programs under mpirun, on one machine with fewer processors than ranks."""
import os
import subprocess

# Open MPI's own names of --allow-run-as-root, --oversubscribe and of ranks that let others work while they wait.
SETTINGS = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
            "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_hwloc_base_binding_policy": "none", "OMP_NUM_THREADS": "1"}


def environment():
    return {**os.environ, **SETTINGS}


def command(mpirun, ranks, arguments):
    return [mpirun, "-n", str(ranks), *map(str, arguments)]


def run(mpirun, ranks, *arguments, timeout=280, **more):
    return subprocess.run(command(mpirun, ranks, arguments), env=environment(), capture_output=True, text=True,
                          timeout=timeout, **more)
