CREATE VIEW firing(time, sensor, value) AS SELECT '2009-03-02 07:12:03', hex(zeroblob(400000000)), 'ON';
