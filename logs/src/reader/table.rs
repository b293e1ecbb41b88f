//! Tables: CSV with commas, semicolons or tabs, and the names of the columns in the first line.

use csv::{ReaderBuilder, StringRecord, Trim};

use super::columns::{Part, part};
use super::log::{Fault, FaultPlace, Form, Log, MOST_US, Pose, Reading};

/// The columns of the parts, each with its unit.
struct Columns {
    time: (usize, f64),
    robot: usize,
    along: [(usize, f64); 2],
    count: usize,
}

const REMEDY: &str = "name columns time, robot, x and y in the first line, with units as in time_ms or \
                      x_mm where they are not seconds and metres";

impl Columns {
    fn of(names: &StringRecord, delimiter: &str) -> Result<Self, Fault> {
        let fault = |bytes, what: String| fault(1, names, delimiter, bytes, what, REMEDY);
        let named = |slot: usize| ["the time", "the robot", "x", "y"][slot];
        let mut found = [None; 4];
        for (column, (part, scale)) in names.iter().enumerate().filter_map(|(c, name)| Some((c, part(name)?)))
        {
            let slot = match part {
                Part::Time => 0,
                Part::Robot => 1,
                Part::Along(axis) => 2 + axis,
            };
            if found[slot].replace((column, scale)).is_some() {
                return Err(fault(Some(column), format!("a second column for {}", named(slot))));
            }
        }
        let missing =
            |slot: usize| found[slot].ok_or_else(|| fault(None, format!("no column for {}", named(slot))));
        Ok(Self {
            time: missing(0)?,
            robot: missing(1)?.0,
            along: [missing(2)?, missing(3)?],
            count: names.len(),
        })
    }

    /// Whether a line has all fields, and the last of them is none of these.
    fn are_before_last(&self, record: &StringRecord) -> bool {
        let used = [self.time.0, self.robot, self.along[0].0, self.along[1].0];
        record.len() == self.count && used.iter().all(|&column| column + 1 < self.count)
    }
}

/// A fault in a field of a record, or in all of it.
fn fault(
    line: u64,
    record: &StringRecord,
    delimiter: &str,
    field: Option<usize>,
    what: String,
    remedy: &str,
) -> Fault {
    let fields: Vec<&str> = record.iter().collect();
    let text = fields.join(delimiter);
    let bytes = field.map_or(0..text.len(), |field| {
        let start = fields[..field].iter().map(|before| before.len() + delimiter.len()).sum();
        start..start + fields[field].len()
    });
    let place = FaultPlace::Line { line: line as usize, text, bytes };
    Fault { place, what, remedy: remedy.to_owned() }
}

/// The fault of the first line that is no text.
fn no_text(bytes: &[u8]) -> Fault {
    let wrong = |(line, bytes)| Some((line, bytes, str::from_utf8(bytes).err()?.valid_up_to()));
    let (line, bytes, start) =
        (1..).zip(bytes.split(|&byte| byte == b'\n')).find_map(wrong).unwrap_or((1, bytes, 0));
    let text = String::from_utf8_lossy(bytes).trim_end().to_owned();
    let place = FaultPlace::Line { line, bytes: start..start + char::REPLACEMENT_CHARACTER.len_utf8(), text };
    let what = "this is not UTF-8 text".to_owned();
    Fault { place, what, remedy: "store the table in UTF-8".to_owned() }
}

pub(super) fn read(bytes: &[u8]) -> Result<Log, Fault> {
    let first = bytes.split(|&byte| byte == b'\n').find(|line| !line.is_empty()).unwrap_or_default();
    let most = |delimiter: &u8| first.split(|byte| byte == delimiter).count();
    let delimiter = [b'\t', b';', b','].into_iter().max_by_key(most).unwrap_or(b',');
    let between = char::from(delimiter).to_string();
    // A line without an end may have lost a part of it, as a number its last digits.
    let whole = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
    let mut reader = ReaderBuilder::new()
        .delimiter(delimiter)
        .flexible(true)
        .trim(Trim::All)
        .has_headers(false)
        .from_reader(bytes);
    let (mut reading, mut record, mut columns) = (Reading::new(Form::Csv), StringRecord::new(), None);
    let (mut line, mut counted) = (1, 0);
    while reader.read_record(&mut record).map_err(|_| no_text(bytes))? {
        // The reader's own number is that of the line before where lines end with CR and LF.
        let start = record.position().map_or(0, |start| start.byte() as usize);
        let start = start + bytes[start..].iter().take_while(|byte| b"\r\n".contains(byte)).count();
        line += bytes[counted..start].split(|&byte| byte == b'\n').count() as u64 - 1;
        counted = start;
        let Some(columns) = &columns else {
            columns = Some(Columns::of(&record, &between)?);
            continue;
        };
        if record.position().is_some_and(|start| start.byte() as usize >= whole)
            && !columns.are_before_last(&record)
        {
            reading.log.cut = Some(line as u32);
            break;
        }
        let Columns { time, robot, along, count } = columns;
        let remedy = "give every line as many fields as the first one";
        if let Some(more) = (*count..record.len()).find(|&more| !record[more].is_empty()) {
            let what = format!("this line has {} fields, and the first one {count}", record.len());
            return Err(fault(line, &record, &between, Some(more), what, remedy));
        }
        let field = |column: usize| {
            let what = || format!("this line has {} fields and no field {}", record.len(), column + 1);
            record.get(column).ok_or_else(|| fault(line, &record, &between, None, what(), remedy))
        };
        let number = |(column, scale): (usize, f64)| {
            let text = field(column)?;
            let what = || format!("{text:?} is no number");
            let remedy = "write numbers as 12.5, and units into the first line, as in x_mm";
            let number = text.parse::<f64>();
            number
                .map(|number| number * scale)
                .map_err(|_| fault(line, &record, &between, Some(column), what(), remedy))
        };
        if field(*robot)?.is_empty() {
            // SUMO writes a line for a moment without a vehicle.
            if field(along[0].0)?.is_empty() && field(along[1].0)?.is_empty() {
                continue;
            }
            let (what, remedy) = ("this line names no robot", "give each position the name of its robot");
            return Err(fault(line, &record, &between, Some(*robot), what.to_owned(), remedy));
        }
        let at_us = number(*time)?;
        if at_us.is_nan() || at_us.abs() > MOST_US {
            let what = "there is no such time".to_owned();
            return Err(fault(line, &record, &between, Some(time.0), what, "write seconds as 12.5"));
        }
        let pose = Pose {
            at_us: at_us.round() as i64,
            robot: field(*robot)?,
            mm: [number(along[0])?, number(along[1])?],
        };
        reading.take(u32::try_from(line).unwrap_or(u32::MAX), pose)?;
    }
    Ok(reading.log)
}
