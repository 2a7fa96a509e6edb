"""Runs the shards of a sweep as tasks of HyperQueue, on two workers.

Usage: hyperqueue_tasks.py PROGRAM FOLDER SHARDS
"""

import sys

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig


def main() -> None:
    program, folder, shards = sys.argv[1:]
    with LocalCluster() as cluster:
        for _ in range(2):
            cluster.start_worker(WorkerConfig(cores=1))
        client = cluster.client()
        job = Job()
        for _ in range(int(shards)):
            job.program([program, "sweep", "--into", folder])
        client.wait_for_jobs([client.submit(job)])


main()
