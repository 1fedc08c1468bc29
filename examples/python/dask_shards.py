#!/usr/bin/env python3
"""Makes a mesh in parts by the processes of a dask cluster: one command of the program a task.

    dask_shards.py MODEL MESH --shards N [--scheduler ADDRESS] [options of tessellate]

Without an address, this machine is the cluster. What is sent between processes are the commands.
"""
import argparse
import shlex
import subprocess
import sys

from dask.distributed import Client


def run(command):
    """Runs one line of the plan; returns what it said where it failed."""
    done = subprocess.run(command, text=True, capture_output=True, check=False)
    return done.stderr if done.returncode else ''


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('model')
    parser.add_argument('mesh')
    parser.add_argument('--shards', default='4')
    parser.add_argument('--scheduler')
    known, options = parser.parse_known_args()
    plan = subprocess.run(['simdbezier', 'plan', known.model, '-o', known.mesh,
                           '--shards', known.shards, *options],
                          text=True, stdout=subprocess.PIPE, check=True).stdout
    *shards, join = [shlex.split(line) for line in plan.splitlines()]
    # Parts are files, and a part that is there is not made again: results need not be pure.
    with Client(known.scheduler or None) as client:
        failed = [text for text in client.gather(client.map(run, shards, pure=False)) if text]
    sys.exit(''.join(failed) or run([*join, '--remove-parts']) or 0)


if __name__ == '__main__':
    main()
