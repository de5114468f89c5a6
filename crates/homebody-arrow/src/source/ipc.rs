//! A file of Arrow IPC: its footer says where its dictionaries and record batches are. All that it says of sizes is held against the
//! size of the file before anything is read into memory.

use super::guard::guarded;
use arrow_array::RecordBatch;
use arrow_buffer::Buffer;
use arrow_ipc::convert::fb_to_schema;
use arrow_ipc::reader::{FileDecoder, read_footer_length};
use arrow_ipc::{Block, RecordBatch as Message, root_as_footer, root_as_message};
use arrow_schema::SchemaRef;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};

/// The end of a file: the footer's length and the magic word.
const TRAILER_BYTES: u64 = 10;

/// A record batch that unpacks to no more than this is read, however well it is packed.
const SMALL_BATCH_BYTES: u64 = 64 << 20;

/// Largest compression ratio of a batch that unpacks to more than `SMALL_BATCH_BYTES`.
const LARGEST_RATIO: u64 = 100;

/// Largest size of an unpacked record batch.
const LARGEST_BATCH_BYTES: u64 = 1 << 30;

pub(super) struct IpcRows {
    file: File,
    size: u64,
    pub schema: SchemaRef,
    decoder: FileDecoder,
    blocks: std::vec::IntoIter<Block>,
}

impl IpcRows {
    pub fn open(mut file: File) -> Result<IpcRows, String> {
        let size = file.seek(SeekFrom::End(0)).map_err(io_message)?;
        let trailer: [u8; TRAILER_BYTES as usize] =
            read(&mut file, size.checked_sub(TRAILER_BYTES), TRAILER_BYTES, size)?
                .try_into()
                .map_err(|_| SHORT.to_owned())?;
        let length = read_footer_length(trailer).map_err(|error| error.to_string())? as u64;
        let footer = read(&mut file, size.checked_sub(TRAILER_BYTES + length), length, size)?;
        let footer = root_as_footer(&footer).map_err(|_| "its footer is none".to_owned())?;
        let schema = footer.schema().ok_or("it tells no columns")?;
        if !schema.endianness().equals_to_target_endianness() {
            return Err("its numbers are written from their other end".into());
        }
        let schema: SchemaRef = guarded(|| Ok::<_, String>(fb_to_schema(schema)))?.into();
        let mut decoder = FileDecoder::new(schema.clone(), footer.version());
        for block in footer.dictionaries().iter().flatten() {
            let message = message_at(&mut file, size, block)?;
            guarded(|| decoder.read_dictionary(block, &message))?;
        }
        let blocks: Vec<Block> = footer.recordBatches().iter().flatten().copied().collect();
        Ok(IpcRows { file, size, schema, decoder, blocks: blocks.into_iter() })
    }

    pub fn project(&mut self, columns: Option<&[usize]>) {
        if let Some(columns) = columns {
            let whole = std::mem::replace(
                &mut self.decoder,
                FileDecoder::new(self.schema.clone(), arrow_ipc::MetadataVersion::V5),
            );
            self.decoder = whole.with_projection(columns.to_vec());
        }
    }
}

impl Iterator for IpcRows {
    type Item = Result<RecordBatch, String>;

    fn next(&mut self) -> Option<Self::Item> {
        let block = self.blocks.next()?;
        let message = message_at(&mut self.file, self.size, &block);
        let rows = message
            .and_then(|message| self.decoder.read_record_batch(&block, &message).map_err(|error| error.to_string()));
        match rows {
            Ok(Some(rows)) => Some(Ok(rows)),
            Ok(None) => self.next(),
            Err(error) => {
                self.blocks = Vec::new().into_iter();
                Some(Err(error))
            }
        }
    }
}

const SHORT: &str = "it ends too early";

fn io_message(error: io::Error) -> String {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => SHORT.into(),
        _ => error.to_string(),
    }
}

fn read(file: &mut File, at: Option<u64>, length: u64, size: u64) -> Result<Vec<u8>, String> {
    let at = at.filter(|at| at.checked_add(length).is_some_and(|end| end <= size)).ok_or(SHORT)?;
    let mut bytes = vec![0; length as usize];
    file.seek(SeekFrom::Start(at)).and_then(|_| file.read_exact(&mut bytes)).map_err(io_message)?;
    Ok(bytes)
}

/// A message, once what it says of sizes is believed.
fn message_at(file: &mut File, size: u64, block: &Block) -> Result<Buffer, String> {
    let part = |length: i64| u64::try_from(length).map_err(|_| SHORT.to_owned());
    let (at, header, body) = (part(block.offset())?, part(block.metaDataLength().into())?, part(block.bodyLength())?);
    let length = header.checked_add(body).ok_or(SHORT)?;
    let bytes = read(file, Some(at), length, size)?;
    // It begins with its length, in old files without a mark before it.
    let begin = if bytes.starts_with(&[0xff; 4]) { 8 } else { 4 };
    let (head, body) = bytes.split_at_checked(header as usize).filter(|(head, _)| head.len() > begin).ok_or(SHORT)?;
    let message = root_as_message(&head[begin..]).map_err(|_| "a message of it is none".to_owned())?;
    let batch = message.header_as_record_batch();
    let of_dictionary = || message.header_as_dictionary_batch().and_then(|dictionary| dictionary.data());
    if let Some(batch) = batch.or_else(of_dictionary) {
        is_believed(&batch, body)?;
    }
    Ok(Buffer::from_vec(bytes))
}

/// Refuses packed buffers without a size, or with one that is too large.
fn is_believed(batch: &Message, body: &[u8]) -> Result<(), String> {
    if batch.compression().is_none() {
        return Ok(());
    }
    let mut all: u64 = 0;
    for buffer in batch.buffers().iter().flatten() {
        let (at, length) = (buffer.offset(), buffer.length());
        if length == 0 {
            continue;
        }
        let (at, length) = (usize::try_from(at).map_err(|_| SHORT)?, usize::try_from(length).map_err(|_| SHORT)?);
        let packed = at.checked_add(length).and_then(|end| body.get(at..end)).ok_or(SHORT)?;
        let (unpacked, packed) = packed.split_first_chunk::<8>().ok_or(SHORT)?;
        // A negative number says that it is not packed.
        let unpacked = u64::try_from(i64::from_le_bytes(*unpacked)).unwrap_or(packed.len() as u64);
        all = all.saturating_add(unpacked);
    }
    let in_proportion = (body.len() as u64).saturating_mul(LARGEST_RATIO);
    let largest = in_proportion.clamp(SMALL_BATCH_BYTES, LARGEST_BATCH_BYTES);
    match all > largest {
        true => Err(format!("a batch of its rows unpacks to more than {} MB", largest >> 20)),
        false => Ok(()),
    }
}
