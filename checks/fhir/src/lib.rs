//! Holds our FHIR R4 bundle against the form that HL7 publishes, as the types of `fhirbolt` are made from it. It is no part of the
//! workspace: those types turn a feature of `serde_json` on that changes how our own files are read.
