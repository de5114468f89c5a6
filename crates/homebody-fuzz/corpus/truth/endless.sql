CREATE TABLE run(ended_at TEXT);
CREATE TABLE cause(firing INTEGER, row INTEGER, resident TEXT, seen_at TEXT, sensor TEXT, why TEXT, thing TEXT);
CREATE TABLE off(row INTEGER, firing INTEGER);
CREATE TABLE room(resident TEXT, at TEXT, room TEXT);
CREATE TABLE movement(resident TEXT, begin_at TEXT, end_at TEXT, kind TEXT, from_x REAL, from_y REAL, to_x REAL, to_y REAL, amplitude_m REAL, posture TEXT);
CREATE VIEW activity(resident, begin_at, end_at, name) AS WITH RECURSIVE n(x) AS (SELECT 0 UNION ALL SELECT x + 1 FROM n) SELECT 'a', '2009-03-02 07:12:03', '2009-03-02 07:13:03', x FROM n;
