CREATE TABLE run(run_id INTEGER PRIMARY KEY, name TEXT, started_at TEXT, ended_at TEXT);
INSERT INTO run VALUES (1, 'tigerplace', '2009-03-02 00:00:00', '2009-03-03 00:00:00');
CREATE TABLE firing(run_id INTEGER, seq INTEGER, time TEXT, sensor TEXT, value TEXT, PRIMARY KEY (run_id, seq)) WITHOUT ROWID;
INSERT INTO firing VALUES (1, 0, '2009-03-02 07:12:03.000000', 'bed motion', 'ON'), (1, 1, '2009-03-02 07:12:05.500000', 'hall motion', 'ON'), (1, 2, '2009-03-02 07:12:09.250000', 'bed motion', 'OFF'), (1, 3, '2009-03-02 09:30:00.000000', 'front door contact', 'OPEN');
