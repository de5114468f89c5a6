// A small flat as the text of a home's file: two rooms, one door between them and one to the outside.

export const FLAT = `{
  "name": "flat",
  "rooms": [
    { "name": "room", "outline": [[0, 0], [4, 0], [4, 3], [0, 3]] },
    { "name": "bath", "outline": [[4, 0], [6, 0], [6, 3], [4, 3]] }
  ],
  "walls": [
    { "from": [0, 0], "to": [6, 0], "thickness_m": 0.2 },
    { "from": [6, 0], "to": [6, 3], "thickness_m": 0.2 },
    { "from": [6, 3], "to": [0, 3], "thickness_m": 0.2 },
    { "from": [0, 3], "to": [0, 0], "thickness_m": 0.2 },
    { "from": [4, 0], "to": [4, 3] }
  ],
  "doors": [
    { "name": "bath door", "from": [4, 1], "to": [4, 1.9] },
    { "name": "front door", "from": [1, 0], "to": [1.9, 0], "open": false, "outside": true }
  ],
  "furniture": [
    { "name": "bed", "at": [1, 2], "size_m": [2, 0.9], "height_m": 0.6, "enterable": true },
    { "name": "stove", "at": [3, 0.4], "size_m": [0.6, 0.6], "height_m": 0.9 }
  ],
  "places": [
    { "name": "window", "at": [2, 1] }
  ],
  "sensors": [
    { "kind": "motion", "name": "room motion", "at": [0.12, 1.5], "facing_deg": 0 },
    { "kind": "bed", "name": "bed sensor", "on": "bed" },
    { "kind": "contact", "name": "bath contact", "on": "bath door" },
    { "kind": "light", "name": "room light", "room": "room" },
    { "kind": "ceiling_motion", "name": "bath motion", "area": [[4.5, 0.5], [5.5, 0.5], [5.5, 1.5], [4.5, 1.5]] }
  ]
}
`;
