#!/usr/bin/env python3
"""Writes one drive in all formats of recordings, each by the library of the format, for tests/node/log-formats.test.ts.

    pip install rosbags mcap mcap-ros1-support mcap-ros2-support && python3 generate.py

Numbers are multiples of 2⁻¹², so that the files are small. recordings.json contains the files, compressed by gzip, as base64. The script
always writes the same rows.
"""

import base64
import gzip
import json
import math
import pathlib
import random
import sqlite3
import tempfile

import numpy as np
from mcap.writer import CompressionType, IndexType
from mcap_ros1.writer import Writer as McapRos1
from mcap_ros2.writer import Writer as McapRos2
from rosbags.rosbag1 import Writer as Bag
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin
from rosbags.rosbag2 import Writer as Rosbag2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

SCRIPT_DIRECTORY = pathlib.Path(__file__).parent
START = 1_700_000_000_123_456_789
ROW_COUNT = 100
rng = random.Random(2005)


def round_to_4096ths(value):
    return round(value * 4096) / 4096


def generate_drive():
    """Generates pairs of rows, one of the odometry and one of the reference: stamp in ns, x, y, qz, qw, v, omega."""
    x = y = theta = 0.0
    for i in range(ROW_COUNT):
        v, omega = 0.5 + 0.2 * math.sin(i / 9), 0.8 * math.sin(i / 23)
        x, y, theta = x + v * 0.05 * math.cos(theta), y + v * 0.05 * math.sin(theta), theta + omega * 0.05
        stamp = START + 50_000_000 * i
        noise = [rng.gauss(0, 0.002) for _ in range(3)]
        yield [
            [stamp, round_to_4096ths(px), round_to_4096ths(py), round_to_4096ths(math.sin(heading / 2)), round_to_4096ths(math.cos(heading / 2)), round_to_4096ths(v), round_to_4096ths(omega)]
            for px, py, heading in ((x * 1.01, y * 1.01, theta * 1.02), (x + noise[0], y + noise[1], theta + noise[2]))
        ]


DRIVE_ROW_PAIRS = list(generate_drive())


class Messages:
    """Messages of the drive in the types of a ROS distribution."""

    def __init__(self, store):
        self.store = store
        if 'tf2_msgs/msg/TFMessage' not in store.types:
            store.register(get_types_from_msg('geometry_msgs/TransformStamped[] transforms', 'tf2_msgs/msg/TFMessage'))
        self.types = store.types

    def __call__(self, name, *args):
        return self.types[name](*args)

    def header(self, i, stamp, frame):
        time = self('builtin_interfaces/msg/Time', stamp // 10**9, stamp % 10**9)
        header = self.types['std_msgs/msg/Header']
        return header(i, time, frame) if 'seq' in header.__dataclass_fields__ else header(time, frame)

    def pose(self, row):
        _, x, y, qz, qw, *_ = row
        return self('geometry_msgs/msg/Pose', self('geometry_msgs/msg/Point', x, y, 0.0), self('geometry_msgs/msg/Quaternion', 0.0, 0.0, qz, qw))

    def twist(self, row):
        vector = self.types['geometry_msgs/msg/Vector3']
        return self('geometry_msgs/msg/Twist', vector(row[5], 0.0, 0.0), vector(0.0, 0.0, row[6]))

    def transform(self, i, row, parent, child):
        _, x, y, qz, qw, *_ = row
        rotation = self('geometry_msgs/msg/Quaternion', 0.0, 0.0, qz, qw)
        transform = self('geometry_msgs/msg/Transform', self('geometry_msgs/msg/Vector3', x, y, 0.0), rotation)
        return self('geometry_msgs/msg/TransformStamped', self.header(i, row[0], parent), child, transform)

    def logs(self):
        """Generates messages of odometry and reference: topic, type, message, time of recording."""
        covariance = np.zeros(36)
        for i, (odometry, reference) in enumerate(DRIVE_ROW_PAIRS):
            pose = self('geometry_msgs/msg/PoseWithCovariance', self.pose(odometry), covariance)
            twist = self('geometry_msgs/msg/TwistWithCovariance', self.twist(odometry), covariance)
            message = self('nav_msgs/msg/Odometry', self.header(i, odometry[0], 'odom'), 'base_link', pose, twist)
            yield '/odom', 'nav_msgs/msg/Odometry', message, odometry[0] + 2_000_000
            message = self('geometry_msgs/msg/PoseStamped', self.header(i, reference[0], 'map'), self.pose(reference))
            yield '/truth', 'geometry_msgs/msg/PoseStamped', message, reference[0] + 3_000_000

    def messages_of_other_types(self):
        """Generates the odometry in messages of all other types that the figure reads. The last message is a static transform."""
        covariance = np.zeros(36)
        for i, (row, _) in enumerate(DRIVE_ROW_PAIRS[:40]):
            stamp = row[0]
            pose = self('geometry_msgs/msg/PoseWithCovariance', self.pose(row), covariance)
            yield '/fused', 'geometry_msgs/msg/PoseWithCovarianceStamped', self('geometry_msgs/msg/PoseWithCovarianceStamped', self.header(i, stamp, 'map'), pose), stamp
            yield '/vicon', 'geometry_msgs/msg/TransformStamped', self.transform(i, row, 'map', 'robot'), stamp
            yield '/pose2d', 'geometry_msgs/msg/Pose2D', self('geometry_msgs/msg/Pose2D', row[1], row[2], 2 * math.atan2(row[3], row[4])), stamp
            yield '/cmd_vel', 'geometry_msgs/msg/Twist', self.twist(row), stamp
            yield '/cmd_stamped', 'geometry_msgs/msg/TwistStamped', self('geometry_msgs/msg/TwistStamped', self.header(i, stamp, ''), self.twist(row)), stamp
            twist = self('geometry_msgs/msg/TwistWithCovariance', self.twist(row), covariance)
            yield '/cmd_fused', 'geometry_msgs/msg/TwistWithCovarianceStamped', self('geometry_msgs/msg/TwistWithCovarianceStamped', self.header(i, stamp, ''), twist), stamp
            wheel_transform = self.transform(i, [stamp, 0.0, 0.1, round_to_4096ths(math.sin(i)), round_to_4096ths(math.cos(i))], 'base_link', 'wheel')
            yield '/tf', 'tf2_msgs/msg/TFMessage', self('tf2_msgs/msg/TFMessage', [self.transform(i, row, 'odom', 'base_footprint'), wheel_transform]), stamp
        fixed_transform = self.transform(0, [stamp, 0.0, 0.0, 0.0, 1.0], 'base_footprint', 'base_link')
        yield '/tf_static', 'tf2_msgs/msg/TFMessage', self('tf2_msgs/msg/TFMessage', [fixed_transform]), stamp


ROS1, ROS2 = Messages(get_typestore(Stores.ROS1_NOETIC)), Messages(get_typestore(Stores.ROS2_HUMBLE))


def write_bag(path, messages, compression=None):
    writer = Bag(path)
    writer.chunk_threshold = 16384
    if compression:
        writer.set_compression(compression)
    with writer:
        connections = {}
        for topic, type_name, message, time in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, type_name, typestore=ROS1.store, callerid='/base')
            writer.write(connections[topic], time, ROS1.store.serialize_ros1(message, type_name))


def write_rosbag2(path, messages, storage, mode=None):
    writer = Rosbag2(path, version=9, storage_plugin=storage)
    if mode:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        connections = {}
        for topic, type_name, message, time in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, type_name, typestore=ROS2.store)
            writer.write(connections[topic], time, ROS2.store.serialize_cdr(message, type_name))


def write_mcap(path, messages, compression, **options):
    """Writes CDR messages by the library of MCAP."""
    from mcap.writer import Writer

    with open(path, 'wb') as stream:
        writer = Writer(stream, chunk_size=16384, compression=compression, **options)
        writer.start('ros2', 'tests')
        channels = {}
        for topic, type_name, message, time in messages:
            if topic not in channels:
                schema = writer.register_schema(type_name, 'ros2msg', b'')
                channels[topic] = writer.register_channel(topic, 'cdr', schema)
            writer.add_message(channels[topic], time, bytes(ROS2.store.serialize_cdr(message, type_name)), time)
        writer.finish()


def dict_of(message):
    """Returns a message as the nested dicts that mcap-ros2-support expects."""
    if hasattr(message, '__dataclass_fields__'):
        names = [name for name in message.__dataclass_fields__ if not name.startswith('__')]
        return {name: dict_of(getattr(message, name)) for name in names}
    return message.tolist() if isinstance(message, np.ndarray) else [dict_of(item) for item in message] if isinstance(message, list) else message


def write_mcap_ros2(path, messages):
    with open(path, 'wb') as stream, McapRos2(stream, chunk_size=16384) as writer:
        schemas = {}
        for topic, type_name, message, time in messages:
            if type_name not in schemas:
                text, _ = ROS2.store.generate_msgdef(type_name, ros_version=2)
                schemas[type_name] = writer.register_msgdef(type_name, text)
            writer.write_message(topic, schemas[type_name], dict_of(message), log_time=time, publish_time=time)


def write_mcap_ros1(path, messages):
    """Writes objects like those of genpy: their class contains the definition of the type, and they can serialize themselves."""

    def genpy_object_of(type_name, message):
        text, md5 = ROS1.store.generate_msgdef(type_name)
        fields = {'_type': type_name.replace('/msg/', '/'), '_full_text': text, '_md5sum': md5}
        serialize = lambda self, buffer: buffer.write(bytes(ROS1.store.serialize_ros1(message, type_name)))
        return type('Message', (), {**fields, 'serialize': serialize})()

    with open(path, 'wb') as stream:
        writer = McapRos1(stream, chunk_size=16384)
        for topic, type_name, message, time in messages:
            writer.write_message(topic, genpy_object_of(type_name, message), log_time=time, publish_time=time)
        writer.finish()


def write_small_bag(path):
    """Writes some messages of the reference, and removes the padding of the header. Fuzzing limits its inputs to 4096 bytes."""
    write_bag(path, [('/odom', *message[1:]) for message in list(ROS1.logs())[1:8:2]])
    data = bytearray(path.read_bytes())
    start = 13 + 4 + int.from_bytes(data[13:17], 'little')
    padding = int.from_bytes(data[start:start + 4], 'little')
    data[start:start + 4 + padding] = bytes(4)
    for field in (b'index_pos=', b'chunk_pos='):
        value_start = data.index(field) + len(field)
        data[value_start:value_start + 8] = (int.from_bytes(data[value_start:value_start + 8], 'little') - padding).to_bytes(8, 'little')
    path.write_bytes(data)


def write_small_database(path):
    """Writes some messages of the reference in pages of 512 bytes, and a topic without messages."""
    database = sqlite3.connect(path)
    database.execute('PRAGMA page_size = 512')
    database.execute('CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)')
    database.execute('CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)')
    database.execute("INSERT INTO topics VALUES (1, '/odom', 'geometry_msgs/msg/PoseStamped', 'cdr'), (2, '/pose', 'geometry_msgs/msg/PoseStamped', 'cdr')")
    for _, type_name, message, time in list(ROS2.logs())[1:12:2]:
        database.execute('INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?, ?)', (time, bytes(ROS2.store.serialize_cdr(message, type_name))))
    database.commit()
    database.close()


def write_table(path, log_index):
    rows = ['t,x,y,qx,qy,qz,qw']
    for row_pair in DRIVE_ROW_PAIRS:
        stamp, x, y, qz, qw, *_ = row_pair[log_index]
        rows.append(f'{stamp // 10**9}.{stamp % 10**9:09d},{x!r},{y!r},0,0,{qz!r},{qw!r}')
    path.write_text('\n'.join(rows) + '\n')


def pack(path):
    """Returns the name of a file and its compressed contents. The name begins with the name of the folder, if there is one."""
    name = path.name if path.parent == WORK_DIRECTORY else f'{path.parent.name}-{path.name}'
    return name, base64.b64encode(gzip.compress(path.read_bytes(), 9, mtime=0)).decode()


with tempfile.TemporaryDirectory() as folder:
    WORK_DIRECTORY = pathlib.Path(folder)
    write_table(WORK_DIRECTORY / 'odometry.csv', 0)
    write_table(WORK_DIRECTORY / 'reference.csv', 1)
    for name, compression in (('none', None), ('bz2', Bag.CompressionFormat.BZ2), ('lz4', Bag.CompressionFormat.LZ4)):
        write_bag(WORK_DIRECTORY / f'{name}.bag', ROS1.logs(), compression)
    write_bag(WORK_DIRECTORY / 'types.bag', ROS1.messages_of_other_types())
    write_small_bag(WORK_DIRECTORY / 'small.bag')
    write_small_database(WORK_DIRECTORY / 'small.db3')
    write_rosbag2(WORK_DIRECTORY / 'sqlite', ROS2.logs(), StoragePlugin.SQLITE3)
    write_rosbag2(WORK_DIRECTORY / 'sqlite-messages', ROS2.logs(), StoragePlugin.SQLITE3, CompressionMode.MESSAGE)
    write_rosbag2(WORK_DIRECTORY / 'sqlite-file', ROS2.logs(), StoragePlugin.SQLITE3, CompressionMode.FILE)
    write_rosbag2(WORK_DIRECTORY / 'mcap-messages', ROS2.logs(), StoragePlugin.MCAP, CompressionMode.MESSAGE)
    write_rosbag2(WORK_DIRECTORY / 'mcap-file', ROS2.logs(), StoragePlugin.MCAP, CompressionMode.FILE)
    for compression in CompressionType:
        write_mcap(WORK_DIRECTORY / f'{compression.name.lower()}.mcap', ROS2.logs(), compression)
    write_mcap(WORK_DIRECTORY / 'unindexed.mcap', ROS2.logs(), CompressionType.ZSTD, index_types=IndexType.NONE, use_statistics=False, repeat_channels=False)
    write_mcap(WORK_DIRECTORY / 'unchunked.mcap', ROS2.logs(), CompressionType.NONE, use_chunking=False)
    write_mcap(WORK_DIRECTORY / 'types.mcap', ROS2.messages_of_other_types(), CompressionType.ZSTD)
    write_mcap_ros2(WORK_DIRECTORY / 'ros2-support.mcap', ROS2.logs())
    write_mcap_ros1(WORK_DIRECTORY / 'ros1-support.mcap', ROS1.logs())
    for part_number in (0, 1):
        write_rosbag2(WORK_DIRECTORY / f'split{part_number}', list(ROS2.logs())[ROW_COUNT * part_number:ROW_COUNT * (part_number + 1)], StoragePlugin.MCAP)
    files = dict(sorted(pack(path) for path in WORK_DIRECTORY.rglob('*') if path.is_file()))
    (SCRIPT_DIRECTORY / 'recordings.json').write_text(json.dumps(files, indent=0) + '\n')
