"""Writes a run as the ROS 2 bag of another robot, by SQLite and the rules of CDR alone."""
import sqlite3
import struct

import numpy as np

JOINTS = [("right_wheel_joint", 5), ("left_hip_joint", 0), ("right_knee_joint", 4), ("left_knee_joint", 1),
          ("left_wheel_joint", 2), ("right_hip_joint", 3)]
EPOCH = 1_732_540_000_000_000_000  # ns

MAPPING = """\
sources: {joints: /joint_states, imu: /imu/data}
joints:
  names: [left_hip_joint, left_knee_joint, left_wheel_joint, right_hip_joint, right_knee_joint, right_wheel_joint]
  sign: [1, 1, 1, -1, -1, -1]
"""


class Cdr:
    def __init__(self):
        self.body = b""

    def put(self, form, *values):
        for value in values:
            self.body += bytes(-len(self.body) % struct.calcsize(form)) + struct.pack("<" + form, value)
        return self

    def text(self, text):
        self.put("I", len(text) + 1)
        self.body += text.encode() + b"\0"
        return self

    def bytes(self):
        return b"\0\1\0\0" + self.body


def header(stamp):
    return Cdr().put("i", stamp // 10**9).put("I", stamp % 10**9).text("base")


def joint_state(stamp, names, position, velocity, effort):
    message = header(stamp).put("I", len(names))
    for name in names:
        message.text(name)
    for values in (position, velocity, effort):
        message.put("I", len(values)).put("d", *values)
    return message.bytes()


def imu(stamp, xyzw, angular_velocity, linear_acceleration):
    zeros = [0.0] * 9
    return header(stamp).put("d", *xyzw, *zeros, *angular_velocity, *zeros, *linear_acceleration, *zeros).bytes()


def write_bag(run, path, every=(2, 5)):
    """Every `every`-th step of joints and IMU. Both legs count the same way; x forward, y left, z up (REP 103)."""
    rows = []
    stamps = [EPOCH + round(1e9 * time) for time in run["time"]]
    sign = np.array([1, 1, 1, -1, -1, -1])
    for k in range(0, run.steps, every[0]):
        values = [[sign[i] * run[key][k, i] for _, i in JOINTS] for key in ("position", "velocity", "torque")]
        rows.append((1, stamps[k] + 1_000_000, joint_state(stamps[k], [name for name, _ in JOINTS], *values)))
    for k in range(0, run.steps, every[1]):
        w, x, y, z = run["orientation"][k]
        forward = np.array([-1, 1, -1])  # from back, left, down
        rows.append((2, stamps[k] + 1_200_000, imu(stamps[k], (-y, -x, w, z), forward * run["angular_velocity"][k],
                                                   forward * run["raw_linear_acceleration"][k])))
    with sqlite3.connect(path) as database:
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT, "
                         "offered_qos_profiles TEXT)")
        database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)")
        database.executemany("INSERT INTO topics VALUES(?, ?, ?, 'cdr', '')",
                             [(1, "/joint_states", "sensor_msgs/msg/JointState"), (2, "/imu/data", "sensor_msgs/msg/Imu")])
        database.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", rows)
    database.close()
