CREATE TABLE states_meta (metadata_id INTEGER PRIMARY KEY, entity_id TEXT);
INSERT INTO states_meta VALUES (1, 'binary_sensor.hall');
CREATE TABLE states (state_id INTEGER PRIMARY KEY, entity_id TEXT, state TEXT, last_changed TEXT, last_changed_ts REAL, last_updated TEXT, last_updated_ts REAL, metadata_id INTEGER);
INSERT INTO states VALUES (1, NULL, 'on', NULL, NULL, NULL, 1235977200.25, 1);
INSERT INTO states VALUES (2, NULL, 'off', NULL, 1235977260.5, NULL, 1235977260.5, 1);
