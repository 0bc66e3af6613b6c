#!/usr/bin/env python3
"""Calls one service from many threads at once, when a line comes in; prints what each got and how
long it took. A program of its own, so that the callers do not hold up who measures.

callers.py SERVICE COUNT"""

import json
import sys
import threading
import time

import rospy
from frontseat_driver.srv import SetLogging


def call(service, start, results):
    proxy = rospy.ServiceProxy(service, SetLogging)
    start.wait()
    began = time.monotonic()
    answer = proxy("XYZ", True)
    results.append({"seconds": time.monotonic() - began, "success": answer.success,
                    "message": answer.message})


def main():
    service, count = sys.argv[1], int(sys.argv[2])
    start = threading.Barrier(count + 1)
    results = []
    threads = [threading.Thread(target=call, args=(service, start, results))
               for _ in range(count)]
    for thread in threads:
        thread.start()
    print("ready", flush=True)
    sys.stdin.readline()
    start.wait()
    for thread in threads:
        thread.join()
    print(json.dumps(results), flush=True)


if __name__ == "__main__":
    main()
