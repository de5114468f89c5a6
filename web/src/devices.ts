// Made from crates/homebody-core/src/sensors/products.rs, which says what each means.

export type Product = {
  /** The key of `preset`. */
  key: string;
  name: string;
  network: string;
  height_m: number;
  field_deg: [number, number];
  reach_m: number;
  refire_s: [number, number];
  /** The sources of the numbers. */
  sources: { height: string; field: string; reach: string; timing: string };
};

export const DEVICES: readonly Product[] = [
  { key: "paper", name: "motion sensor, as measured by Godsey & Skubic 2009", network: "", height_m: 2.1, field_deg: [145, 50], reach_m: 10, refire_s: [6.0, 8.0], sources: {"height":"not stated; our choice","field":"Godsey & Skubic 2009, section III.D","reach":"not stated; our choice","timing":"Godsey & Skubic 2009, section III.D"} },
  { key: "x10_ms16a", name: "X10 ActiveEye MS16A", network: "X10 radio", height_m: 2.1, field_deg: [145, 50], reach_m: 10, refire_s: [10.0, 10.0], sources: {"height":"our choice, above the 6 ft (1.83 m) in the manual of the related HawkEye MS13A","field":"not stated by the maker; value of Godsey & Skubic 2009","reach":"not stated; our choice","timing":"X10 Active Eye setup guide"} },
  { key: "casas_pulse", name: "Bosch unit of CASAS homes", network: "", height_m: 2.1, field_deg: [145, 50], reach_m: 10, refire_s: [5.4, 5.6], sources: {"height":"not stated; our choice","field":"not stated by the maker; value of Godsey & Skubic 2009","reach":"not stated; our choice","timing":"measured in the log of a CASAS home"} },
  { key: "casas_follow", name: "Control4 unit of CASAS homes", network: "Zigbee", height_m: 2.1, field_deg: [145, 50], reach_m: 10, refire_s: [0.55, 0.65], sources: {"height":"not stated; our choice","field":"not stated by the maker; value of Godsey & Skubic 2009","reach":"not stated; our choice","timing":"measured in the logs of CASAS homes"} },
  { key: "aqara", name: "Aqara RTCGQ11LM", network: "Zigbee", height_m: 2.1, field_deg: [170, 50], reach_m: 7, refire_s: [60.0, 60.0], sources: {"height":"not stated; our choice","field":"horizontal from a review of the related T1 RTCGQ12LM (privatehomelab.com); vertical as in Godsey & Skubic 2009","reach":"a review of the related T1 RTCGQ12LM (privatehomelab.com)","timing":"Zigbee2MQTT, page RTCGQ11LM"} },
  { key: "hue", name: "Philips Hue motion sensor", network: "Zigbee", height_m: 2.1, field_deg: [145, 50], reach_m: 10, refire_s: [10.0, 10.0], sources: {"height":"not stated; our choice","field":"not stated by the maker; value of Godsey & Skubic 2009","reach":"not stated; our choice","timing":"not stated; our choice"} },
  { key: "aqara_p1", name: "Aqara P1 RTCGQ14LM", network: "Zigbee", height_m: 2.1, field_deg: [170, 50], reach_m: 7, refire_s: [30.0, 30.0], sources: {"height":"not stated; our choice","field":"horizontal from a review of the related T1 RTCGQ12LM (privatehomelab.com); vertical as in Godsey & Skubic 2009","reach":"a review of the related T1 RTCGQ12LM (privatehomelab.com)","timing":"deCONZ REST documentation, page xiaomi_rtcgq14lm_p1_presence_sensor"} },
  { key: "fibaro", name: "Fibaro FGMS-001", network: "Z-Wave", height_m: 2.4, field_deg: [145, 50], reach_m: 10, refire_s: [8.0, 8.0], sources: {"height":"operating manual of the FGMS-001, v2.4","field":"not stated by the maker; value of Godsey & Skubic 2009","reach":"not stated; our choice","timing":"OpenZWave, config/fibaro/fgms.xml, parameter 2"} },
  { key: "aeotec", name: "Aeotec TriSensor ZWA005", network: "Z-Wave", height_m: 2.1, field_deg: [145, 50], reach_m: 10, refire_s: [30.0, 30.0], sources: {"height":"not stated; our choice","field":"not stated by the maker; value of Godsey & Skubic 2009","reach":"not stated; our choice","timing":"manual of the ZWA005, parameter 1"} },
];
