"""Stands for an arm in a cell, a tracker, a logger and a programmer: shares no code with demecal.

make URDF BASE TIP LANGUAGE FOLDER   writes tracker.txt, joints.log and program.*, of an arm that is not as its URDF says
judge FOLDER PROGRAM X,Y,Z           where the tool point (mm) of that arm comes to by the program as it was written and
                                     by PROGRAM, from where it should be: rms and largest, mm, of both
"""
import json
import math
import random
import re
import sys
import xml.etree.ElementTree as xml

TOOL_M = [0.11, -0.07, 0.19]
START_S, AHEAD_S = 85893.0, 417.0  # the tracker's clock, which shows no date, passes midnight


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def place(turn, at):
    return [list(turn[i]) + [at[i]] for i in range(3)] + [[0, 0, 0, 1]]


def about(axis, angle):
    n = math.sqrt(sum(v * v for v in axis)) or 1.0
    x, y, z = (v / n for v in axis)
    c, s = math.cos(angle), math.sin(angle)
    d = 1 - c
    return [[c + x * x * d, x * y * d - z * s, x * z * d + y * s],
            [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
            [z * x * d - y * s, z * y * d + x * s, c + z * z * d]]


def inverse(a):
    turned = [[a[j][i] for j in range(3)] for i in range(3)]
    return place(turned, [-sum(turned[i][k] * a[k][3] for k in range(3)) for i in range(3)])


def origin(xyz, rpy):
    turns = [place(about(axis, rpy[k]), [0, 0, 0]) for k, axis in ((2, [0, 0, 1]), (1, [0, 1, 0]), (0, [1, 0, 0]))]
    return product(place(about([1, 0, 0], 0), xyz), product(turns[0], product(turns[1], turns[2])))


class Arm:
    """joints: [origin xyz, rpy, axis or None where it is fixed, zero, limits]; before: from base to the first."""

    def __init__(self, urdf, base, tip):
        by_child = {}
        for joint in xml.parse(urdf).getroot().findall('joint'):
            numbers = lambda tag, key, default: [
                float(v) for v in (joint.find(tag).get(key, default) if joint.find(tag) is not None else default).split()]
            limit = joint.find('limit')
            limits = [float(limit.get('lower', -3)), float(limit.get('upper', 3))] if limit is not None else [-3, 3]
            moves = joint.get('type') in ('revolute', 'continuous')
            by_child[joint.find('child').get('link')] = (joint.find('parent').get('link'), [
                numbers('origin', 'xyz', '0 0 0'), numbers('origin', 'rpy', '0 0 0'),
                numbers('axis', 'xyz', '1 0 0') if moves else None, 0.0, limits])
        above = lambda link: [link] + (above(by_child[link][0]) if link in by_child else [])
        shared = next(link for link in above(base) if link in above(tip))
        self.joints = [by_child[link][1] for link in reversed(above(tip)[:above(tip).index(shared)])]
        self.before = place(about([1, 0, 0], 0), [0, 0, 0])
        for link in above(base)[:above(base).index(shared)]:
            self.before = product(self.before, inverse(origin(*by_child[link][1][:2])))

    def moving(self):
        return [joint for joint in self.joints if joint[2] is not None]

    def disturb(self, dice):
        """Zeros from joint 2 on, links from joint 3 on: what leaves no doubt about where the base is."""
        for number, joint in enumerate(self.moving()):
            joint[3] = dice.gauss(0, 2e-3) if number > 0 else 0.0
            if number > 1:
                joint[0] = [v + dice.gauss(0, 3e-4) for v in joint[0]]
                joint[1] = [v + dice.gauss(0, 5e-4) for v in joint[1]]

    def frames(self, q):
        """The flange, and of every moving joint its axis and a point on it."""
        at, axes, number = self.before, [], 0
        for xyz, rpy, axis, zero, _ in self.joints:
            at = product(at, origin(xyz, rpy))
            if axis is None:
                continue
            turn = [sum(at[i][k] * axis[k] for k in range(3)) for i in range(3)]
            axes.append((turn, [at[i][3] for i in range(3)]))
            at = product(at, place(about(axis, q[number] + zero), [0, 0, 0]))
            number += 1
        return at, axes

    def tool(self, q, tool=None):
        return product(self.frames(q)[0], place(about([1, 0, 0], 0), tool or TOOL_M))

    def joints_at(self, pose, q):
        """As a controller finds them: by Newton's method from joints nearby."""
        q = list(q)
        for _ in range(50):
            at, (_, axes) = self.tool(q), self.frames(q)
            point = [at[i][3] for i in range(3)]
            rest = product(pose, inverse(at))
            turn = [(rest[2][1] - rest[1][2]) / 2, (rest[0][2] - rest[2][0]) / 2, (rest[1][0] - rest[0][1]) / 2]
            off = [pose[i][3] - point[i] for i in range(3)] + turn
            if max(map(abs, off)) < 1e-12:
                return q
            columns = []
            for axis, on in axes:
                arm = [point[i] - on[i] for i in range(3)]
                columns.append([axis[1] * arm[2] - axis[2] * arm[1], axis[2] * arm[0] - axis[0] * arm[2],
                                axis[0] * arm[1] - axis[1] * arm[0]] + list(axis))
            q = [a + b for a, b in zip(q, solved([[c[i] for c in columns] + [off[i]] for i in range(6)]))]
        raise ValueError('the pose is out of reach')


def solved(rows):
    for i in range(6):
        pivot = max(range(i, 6), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(6):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[i])]
    return [rows[i][6] / rows[i][i] for i in range(6)]


def turn_vector(pose):
    w, x, y, z = quaternion(pose)
    n = math.sqrt(x * x + y * y + z * z)
    factor = 2 * math.atan2(n, w) / n if n > 1e-9 else 2.0
    return [factor * x, factor * y, factor * z]


def quaternion(pose):
    w = math.sqrt(max(0, 1 + pose[0][0] + pose[1][1] + pose[2][2])) / 2
    if w > 0.1:
        return [w] + [(pose[a][b] - pose[b][a]) / (4 * w) for a, b in ((2, 1), (0, 2), (1, 0))]
    # Turned further by half a turn about an axis: q * i, q * j or q * k taken back.
    for k, axis in enumerate(([1, 0, 0], [0, 1, 0], [0, 0, 1])):
        w, x, y, z = quaternion_or_none(product(pose, place(about(axis, math.pi), [0, 0, 0]))) or [0] * 4
        if (w, x, y, z) != (0, 0, 0, 0):
            return [[x, -w, -z, y], [y, z, -w, -x], [z, -y, x, -w]][k]


def quaternion_or_none(pose):
    return quaternion(pose) if 1 + pose[0][0] + pose[1][1] + pose[2][2] > 0.5 else None


def from_quaternion(w, x, y, z):
    n = math.sqrt(x * x + y * y + z * z)
    return about([x, y, z] if n > 1e-12 else [1, 0, 0], 2 * math.atan2(n, w))


def abc(pose):
    return [math.atan2(pose[1][0], pose[0][0]), math.atan2(-pose[2][0], math.hypot(pose[0][0], pose[1][0])),
            math.atan2(pose[2][1], pose[2][2])]


def comma(value, decimals=3):
    return f'{value:.{decimals}f}'.replace('.', ',')


def clock(seconds, sign):
    seconds %= 86400
    return f'{int(seconds // 3600):02}:{int(seconds // 60 % 60):02}:{int(seconds % 60):02}{sign}{round(seconds % 1 * 10)}'


# Of every language: how its log heads joints and counts them, and what a program's targets look like.
LANGUAGES = {
    'urscript': ('.script', [f'actual_q_{j}' for j in range(6)], 1.0, r'movej\(\[([^]]*)\]', r'movel\(p\[([^]]*)\]'),
    'rapid': ('.mod', [f'J{j}' for j in range(1, 7)], math.degrees(1), r'jointtarget \w+:=\[\[([^]]*)\]',
              r'robtarget \w+:=\[\[([^]]*\],\[[^]]*)\]'),
    'krl': ('.src', [f'A{j} [deg]' for j in range(1, 7)], math.degrees(1), r'PTP \{(A1[^}]*)\}', r'LIN \{(X[^}]*)\}'),
    'csv': ('.csv', [f'iiwa_joint_{j}' for j in range(1, 8)], 1.0, r'(?m)^([-0-9.][^\n]*)$', r'(?!)'),
}

# Joints about which the arms of these languages work, rad.
MIDDLES = {
    'urscript': [0, -1.4, 1.6, -1.5, -1.5, 0], 'rapid': [0.1, 0.1, 0.2, 0.3, 0.9, 0.2],
    'krl': [0, -1.3, 1.6, 0.2, 0.9, 0], 'csv': [0, 0.5, 0, -0.7, 0, 0.6, 0],
}


def written(language, stops):
    """A program that drives to joints near each place, and by a line to the place itself."""
    tool = [1e3 * v for v in TOOL_M]
    text = lambda values, decimals: ','.join(f'{v:.{decimals}f}' for v in values)
    degrees = lambda q: [math.degrees(v) for v in q]
    point = lambda pose, unit: [unit * pose[i][3] for i in range(3)]
    if language == 'urscript':
        lines = [f'  movej([{text(near, 6)}], a=1.0, v=0.5)\n  movel(p[{text(point(pose, 1) + turn_vector(pose), 6)}], v=0.1)\n'
                 for near, _, pose in stops]
        return f'def cell():\n  set_tcp(p[{text(TOOL_M, 4)},0,0,0])\n{"".join(lines)}end\n'
    if language == 'rapid':
        quarter = lambda angle: math.floor(math.degrees(angle) / 90)
        rest = '[9E9,9E9,9E9,9E9,9E9,9E9]'
        data = [f'  CONST jointtarget j{i}:=[[{text(degrees(near), 4)}],{rest}];\n'
                f'  CONST robtarget p{i}:=[[{text(point(pose, 1e3), 3)}],[{text(quaternion(pose), 7)}],'
                f'[{quarter(q[0])},{quarter(q[3])},{quarter(q[5])},0],{rest}];\n' for i, (near, q, pose) in enumerate(stops)]
        moves = [f'    MoveAbsJ j{i},v500,fine,probe;\n    MoveL p{i},v100,fine,probe;\n' for i in range(len(stops))]
        return (f'MODULE cell\n  PERS tooldata probe:=[TRUE,[[{text(tool, 1)}],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\n'
                f'{"".join(data)}  PROC main()\n{"".join(moves)}  ENDPROC\nENDMODULE\n')
    if language == 'krl':
        named = lambda names, values, decimals: ','.join(f'{n} {v:.{decimals}f}' for n, v in zip(names, values))
        lines = [f'PTP {{{named(["A1", "A2", "A3", "A4", "A5", "A6"], degrees(near), 4)}}}\n'
                 f'LIN {{{named("XYZABC", point(pose, 1e3) + degrees(abc(pose)), 4)}}}\n' for near, _, pose in stops]
        return f'DEF cell()\n$BASE=$NULLFRAME\n$TOOL={{{named("XYZABC", tool + [0, 0, 0], 1)}}}\n{"".join(lines)}END\n'
    heads = ','.join(f'q{j}_deg' for j in range(1, 8))
    return heads + '\n' + ''.join(text(degrees(near), 4) + '\n' for near, _, _ in stops)


def read(language, text):
    """The joints and poses that a program holds, rad and m."""
    _, _, _, joints, poses = LANGUAGES[language]
    values = lambda match: [float(v) for v in re.findall(r'(?<![A-Za-z])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?', match)]
    angle, length = (1.0, 1.0) if language == 'urscript' else (math.radians(1), 1e-3)
    found = [[angle * v for v in values(match)] for match in re.findall(joints, text)]
    places = []
    for match in re.findall(poses, text):
        v = values(match)
        at, turn = [length * x for x in v[:3]], v[3:]
        if language == 'rapid':
            places.append(place(from_quaternion(*turn), at))
        elif language == 'krl':
            a, b, c = (math.radians(x) for x in turn[:3])
            places.append(origin(at, [c, b, a]))
        else:
            n = math.sqrt(sum(x * x for x in turn))
            places.append(place(about(turn, n), at))
    return found, places


def make(urdf, base, tip, language, folder):
    ending, heads, factor, _, _ = LANGUAGES[language]
    nominal, true, dice = Arm(urdf, base, tip), Arm(urdf, base, tip), random.Random(2718)
    true.disturb(dice)
    middle = MIDDLES[language]
    limits = [(max(low, at - 1.2), min(high, at + 1.2)) for (*_, (low, high)), at in zip(nominal.moving(), middle)]
    # Where the instrument has the base.
    base_there = origin([2.1, -0.7, 0.4], [0.02, -0.01, 2.0])
    before, log, points = middle, [], []
    for pose in range(60):
        q = [dice.uniform(low, high) for low, high in limits]
        for row in range(30):
            share = min(1.0, row / 12.0)
            angles = [factor * ((1 - share) * a + share * b) for a, b in zip(before, q)]
            log.append(f'2026-11-24 {clock(START_S + 3 * pose + row / 10, ".")}\t' + '\t'.join(f'{v:.7f}' for v in angles))
        at = product(base_there, true.tool(q))
        point = [1e3 * at[i][3] + dice.gauss(0, 0.01) for i in range(3)]
        points.append(f'P{pose + 1};{clock(START_S + AHEAD_S + 3 * pose + 2.2, ",")};' + ';'.join(map(comma, point)))
        before = q
    with open(f'{folder}/tracker.txt', 'w', encoding='utf-8-sig') as file:
        file.write('Aufmaß der Zelle\n\nPunkt;Zeit;X [mm];Y [mm];Z [mm]\n' + '\n'.join(points) + '\n')
    with open(f'{folder}/joints.log', 'w') as file:
        file.write('timestamp\t' + '\t'.join(heads) + '\n' + '\n'.join(log) + '\n')
    stops = []
    for _ in range(12):
        q = [v + dice.uniform(-0.4, 0.4) for v in middle]
        stops.append(([v + dice.uniform(-0.05, 0.05) for v in q], q, nominal.tool(q)))
    with open(f'{folder}/program{ending}', 'w') as file:
        file.write(written(language, stops))
    with open(f'{folder}/truth.json', 'w') as file:
        json.dump({'urdf': urdf, 'base': base, 'tip': tip, 'language': language, 'joints': true.joints}, file)


def judge(folder, program, tool):
    truth = json.load(open(f'{folder}/truth.json'))
    nominal, true = (Arm(truth['urdf'], truth['base'], truth['tip']) for _ in range(2))
    true.joints = truth['joints']
    asked = read(truth['language'], open(f'{folder}/program{LANGUAGES[truth["language"]][0]}').read())
    sent = read(truth['language'], open(program).read())
    assert [len(group) for group in asked] == [len(group) for group in sent] and len(asked[0]) == 12
    for joints, poses in (asked, sent):
        off = []
        for number, meant in enumerate(asked[0]):
            off.append((nominal.tool(meant, tool), true.tool(joints[number])))
            if poses:
                off.append((asked[1][number], true.tool(nominal.joints_at(poses[number], meant))))
        errors = [1e3 * math.dist([a[i][3] for i in range(3)], [b[i][3] for i in range(3)]) for a, b in off]
        print(math.sqrt(sum(e * e for e in errors) / len(errors)), max(errors), end=' ')
    print()


if sys.argv[1] == 'make':
    make(*sys.argv[2:])
else:
    judge(sys.argv[2], sys.argv[3], [1e-3 * float(v) for v in sys.argv[4].split(',')])
